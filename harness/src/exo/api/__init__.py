"""What `exo` offers to Python programs; all of it has its name in `exo.__all__`. Its manual: docs/python.md.

| module | what it has |
|---|---|
| `fmu.py` | `load`: an FMU and its variables |
| `system.py` | `couple`: FMUs that are wired |
| `simulating.py` | `simulate`: a system or a scenario's case, run |
| `signals.py` | what is given to inputs during a run |
| `run.py` | `Run`, `read_run`: what a run leaves, as tables, pictures and files |
| `picture.py` | how a run is drawn |
"""
