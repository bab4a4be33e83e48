"""Broken FMUs: good ones in which one thing was changed."""
