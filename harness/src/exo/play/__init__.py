"""`exo play`: a page on this machine where one pushes the handle with the mouse while the FMUs answer in real time.

| module | what |
|---|---|
| `bench` | the two benches, testbed and arm: what can be set, what is shown, where the hand pushes |
| `hand` | the mouse as a hand: a spring from its target to the handle |
| `live` | the run: the FMUs, stepped by the clock in chunks |
| `contact` | sticks or lets go |
| `saved` | a run that was played, as a scenario that repeats it bit for bit |
| `server` | page and socket: this machine only, with a token |
"""
