"""The process that touches foreign machine code: `python -m exo.probe <facts file>`, the task as JSON on stdin.

Plain ctypes and the standard library: what is under test is the FMU, not a wrapper, and the process starts fast. It is
started by `exo.validate.child`, which reads the facts. Task `inspect` parses a library's file, `load` runs an instance
through one step, `trial` runs one experiment of `trials.py`.
"""
