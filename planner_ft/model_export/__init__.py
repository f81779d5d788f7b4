"""A candidate with its adapter as one model that other programs load: a transformers folder in full
precision, and a GGUF file.

`run.export` does it: `check` folds the adapter in and compares answers before and after,
`gguf_file` writes the model as llama.cpp reads it.
"""

from planner_ft.model_export.run import Exported, ExportSettings, export

__all__ = ["ExportSettings", "Exported", "export"]
