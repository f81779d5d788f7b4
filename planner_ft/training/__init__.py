"""Fine-tuning: settings, preflight, batches, training loop, checkpoints, adapter folder."""
