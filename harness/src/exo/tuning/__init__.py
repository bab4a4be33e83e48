"""The gain guide: which gains keep the sampled loop stable on a given machine, and by how much.

machine (data) → region (limits and margins from the closed form of `exo.theory`) → guide (numbers, recommendations) →
show (table, JSON, map). docs/tuning.md explains the numbers.
"""
