"""The flags of `plannerft bench --endpoint`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from planner_ft.benchmark.sources.endpoint_settings import EndpointSettings


def with_endpoint(
    named: dict[str, Any], served: dict[str, Any]
) -> tuple[dict[str, Any], EndpointSettings | None]:
    """The run's flags with the served model as its only candidate, and the server, if --endpoint is
    given. Raises PlannerError.

    `named` are the flags that say what is run, `served` those that go with --endpoint, both without
    what was not given.
    """
    if not served:
        return named, None
    from planner_ft.benchmark.sources.endpoint_settings import EndpointSettings
    from planner_ft.support.errors import PlannerError

    if "endpoint" not in served or "model" not in served:
        flags = ", ".join(f"--{name.replace('_', '-')}" for name in served)
        raise PlannerError(f"{flags}: a server needs both --endpoint URL and --model NAME")
    if "candidates" in named:
        raise PlannerError(
            "--candidates are loaded here and --endpoint is asked over the network: give one of"
            " them"
        )
    url = served.pop("endpoint")
    # A server's model is the one that it is; whether it was fine-tuned, and so needs no vocabulary,
    # only the user knows.
    return {
        "configurations": "base",
        **named,
        "candidates": served["model"].replace(",", " "),
    }, EndpointSettings(url, **served)
