"""The digest of a plan document: SHA-256 over its canonical form (RFC 8785), so that anybody can
compute it.
"""

from __future__ import annotations

import hashlib
from typing import Any

import rfc8785

LARGEST = 2**53 - 1
"""Larger whole numbers have no exact form in RFC 8785 (I-JSON, RFC 7493)."""


def canonical(value: Any) -> bytes:
    """A JSON value in the canonical form of RFC 8785; whole numbers beyond 2^53 - 1 as the
    floating-point numbers that they are to most readers.
    """
    return rfc8785.dumps(_exact(value))


def sha256_canonical(value: Any) -> str:
    """Hexadecimal SHA-256 over the canonical form of a JSON value."""
    return hashlib.sha256(canonical(value)).hexdigest()


def document_digest(document: dict[str, Any]) -> str:
    """The digest of a plan document: of all of it but the key `digest`."""
    return sha256_canonical({key: value for key, value in document.items() if key != "digest"})


def altered(document: dict[str, Any]) -> bool:
    """Whether a document is not what its digest says: changed by hand, or by a program that does
    not know it.
    """
    return document.get("digest") != document_digest(document)


def _exact(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _exact(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_exact(item) for item in value]
    if isinstance(value, int) and not isinstance(value, bool) and abs(value) > LARGEST:
        return float(value)
    return value
