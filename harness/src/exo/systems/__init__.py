"""Coupled systems for other tools: FMUs, wiring and parameter sets of the scenarios, as SSP archives."""
