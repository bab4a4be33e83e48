"""References inside an FMU, as FMI-LS-REF has them: what the FMU should do, for an importer to try.

Reading and replaying, any FMU's; of the harness they need the validator's archive, child and rules
(`exo/validate/references.py`) only:

| file | what |
|---|---|
| `names.py` | names of the standard |
| `xml.py` | XML of an archive, read without trusting it |
| `manifest.py`, `experiments.py` | what there is; what is to be run |
| `variables.py`, `series.py`, `parameters.py` | columns and parameters as variables of the FMU, also of vectors |
| `player.py` | one experiment, run by fmpy, in a process of its own |
| `outcome.py` | by how much outputs differ |
| `replay.py` | all of it: `replay(path)` |

Writing those of this project's FMUs: `recipes.toml`, `recipes.py`, `record.py`, `sets.py`, `requirements.py`,
`document.html.jinja`, `write.py`.
"""
