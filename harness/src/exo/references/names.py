"""Names of FMI-LS-REF and of the experiments format, for those who write and those who read."""

#: The layered standard and the version that is written; versions before it are read, too.
NAME = "org.fmi-standard.fmi-ls-ref"
VERSION = "1.0.0-beta.1"
#: Fixed by its schema.
DESCRIPTION = "Layered Standard providing information on related files included in an FMU."
#: Where the files lie in an archive.
FOLDER = f"extra/{NAME}"
MANIFEST = "fmi-ls-manifest.xml"
#: Namespace of the three attributes that all layered standards' manifests have.
FMI_LS = "http://fmi-standard.org/fmi-ls-manifest"
#: The experiments format: MA-HS-Experiments, and as FMI-LS-REF called it while it was an appendix.
EXPERIMENTS_TYPE = "application/x-ma-hs-experiments"
OLD_EXPERIMENTS_TYPE = "application/x-ma-ls-experiments"
SSV_TYPE = "application/x-ssp-parameter-set"
CSV_TYPE = "text/csv"
