"""Making the embedded candidate: tokenizer, corpus of synthetic (command, plan) text, pretraining
loop.
"""
