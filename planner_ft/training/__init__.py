"""Fine-tuning: settings, preflight, batches, the training loop with its checkpoints, and the
adapter folder it leaves.
"""
