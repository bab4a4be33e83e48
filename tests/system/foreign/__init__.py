"""FMUs as other importers run them: one record of inputs, one function an importer, and the table of what was run.

| module | what |
|---|---|
| `record` | inputs that move everything an FMU has, as data and as a file |
| `runs` | a record through fmpy, libcosim, the `fmi` crate, and inside a container |
| `cosim` | any coupling through libcosim, in a process of its own (`cosim_child`) |
| `contents` | what is in a folder, for archives in odd places (`frozen_child`: in one that cannot be written) |
| `matrix` | `matrix.toml`, from which docs/importers.md gets its tables |
"""
