"""What README.md and docs/ say of the repository, to be compared with it.

| module | what |
|---|---|
| `names.py` | files, scenarios, tests, words and labels that a document names; the map from the paper to the code |
| `citations.py` | sections and subjects of the specification that verdicts cite |
| `assumptions.py` | the assumptions table, made from `docs/assumptions.toml` and `docs/assumptions.json` |
"""
