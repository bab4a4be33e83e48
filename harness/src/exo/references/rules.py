"""The rules. What breaks only the draft of the layered standard, and hinders nobody, is a warning."""

from exo.validate.rule import error, warning

XML = error("reference-xml", "manifest, experiments and parameter sets of FMI-LS-REF are well-formed XML without document types")
MANIFEST = warning("reference-manifest", "the manifest of FMI-LS-REF has the elements, attributes and roles of its schema")
RELATED = warning("reference-related", "a file that the manifest names by a relative address is in the archive")
EXPERIMENT = error("reference-experiment", "an experiments file has names, times, a step size and a tolerance that make sense")
MISSING = error("reference-missing", "parameters, stimuli and results that an experiment names by a relative address are in the archive")
SERIES = error("reference-series", "a CSV file has the column time, which does not decrease, and in each row one finite number a column")
VARIABLE = error("reference-variable", "columns are variables of the FMU: of stimuli inputs or tunable parameters, of results numbers")
PARAMETER = error("reference-parameter", "a parameter can be set, and its value is of the variable's kind")
UNKNOWN = warning("reference-parameter-unknown", "a parameter set names variables of the FMU: others set nothing")
UNIT = warning("reference-unit", "a parameter's unit is that of the variable")
RUN = error("reference-run", "an experiment runs to its end")
RESULT = error("reference-result", "outputs differ from reference results by no more than the experiment's tolerance")
UNSTATED = warning("reference-result-unstated", "where an experiment states no tolerance, outputs differ by no more than 1e-3")
