"""Constrained decoding: which tokens may follow, so that an answer cannot leave the rules of its
strength.

`answer.constraint_factory` compiles once per (tokenizer, level, vocabulary, strength); `start`
gives the state of one answer, which the generation loop asks what may follow and tells every
token that was chosen. What may be written as a value is in `grammar` (schema) and
`grounded`, what may follow what in `scripts`.
"""

import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.int32]
"""Allowed tokens as bits of ceil(n_vocab / 32) words: token t is bit t % 32 of word t // 32."""
TOO_LONG = "The command is too long to hold texts to its words."
UNPAIRED = "The coordinates in the command could not be read with certainty."
RAN_ON = "The facts of the command led to a plan that ran on; this one is held to the schema alone."
RELEASED = "A value of {name} has no evidence in the command; it is the model's."
