"""The rules of `exo.references`. What breaks only the draft of the standard, and hinders nobody, is a warning."""

from exo.validate.rule import error, warning

XML = error("reference-xml", "manifest, experiments and parameter sets are well-formed XML without document types")
MANIFEST = warning("reference-manifest", "the manifest of FMI-LS-REF has its schema's elements, attributes and roles")
RELATED = warning("reference-related", "a file that the manifest names by a relative address is in the archive")
EXPERIMENT = error("reference-experiment", "experiments have names, times, a step size and a tolerance that make sense")
MISSING = error("reference-missing", "a file that an experiment names by a relative address is in the archive")
SERIES = error("reference-series", "a CSV file has the column time, which does not decrease, and finite numbers")
VARIABLE = error("reference-variable", "columns are variables; those of stimuli are inputs or tunable parameters")
PARAMETER = error("reference-parameter", "a parameter can be set, and its value is of the variable's kind")
UNKNOWN = warning("reference-parameter-unknown", "a parameter set names variables of the FMU: others set nothing")
UNIT = warning("reference-unit", "a parameter's unit is that of the variable")
RUN = error("reference-run", "an experiment runs to its end")
RESULT = error("reference-result", "outputs differ from reference results by no more than the stated tolerance")
UNSTATED = warning("reference-result-unstated", "where no tolerance is stated, outputs differ by no more than 1e-3")
