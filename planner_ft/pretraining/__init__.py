"""Making the embedded candidate: tokenizer, corpus of synthetic plans, pretraining loop."""
