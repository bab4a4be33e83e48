"""What `cargo xtask bench` measures: one table of ratios, each within one run. `python -m benches` prints it.

| module | what |
|---|---|
| `__main__` | the list of providers, the command |
| `row` | what a provider yields: a row of the table, a sheet of figures, or what was not run and why |
| `turns` | fair comparisons: rounds in turns, medians, pinned to a core |
| `native` | C sources of this folder as libraries and programs |
| `machine`, `document`, `picture` | the machine, `docs/benchmarks.md`, `docs/benchmarks.png` |
| `same_arithmetic`, `in_c` | controller and arm beside law and arm in C, and those through ctypes |
| `floor`, `instructions`, `arm_step`, `engines`, `peers`, `sweeps`, `lifetime`, `clock` | the providers |

A provider is a module with `measure(bench)`, which yields `Row`, `Sheet` and `NotRun`.
"""
