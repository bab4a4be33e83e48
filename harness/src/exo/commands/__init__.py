"""The commands, a module for each idea; `exo.cli` gives them their names."""
