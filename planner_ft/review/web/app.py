"""The application: page, state, changes, events. What may come in at all is the guard's matter."""

from __future__ import annotations

import asyncio
import contextlib
import math
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect, Request
from starlette.responses import (
    JSONResponse,
    PlainTextResponse,
    RedirectResponse,
    Response,
    StreamingResponse,
)
from starlette.routing import Route
from starlette.types import ASGIApp, ExceptionHandler

from planner_ft.review.approval import UnacknowledgedError
from planner_ft.review.store import ChangedError
from planner_ft.review.web.guard import ASK_THE_TERMINAL, LARGEST_BODY, Door, Guard, too_large
from planner_ft.review.web.planning import BusyError
from planner_ft.review.web.session import Session
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, decode_json

PAGE = Path(__file__).parent / "page"
TYPES = {
    ".js": "text/javascript",
    ".css": "text/css",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".txt": "text/plain",
}
"""Files of the page that are served, by how their names end."""
LOOK_EVERY = 1.0
"""Seconds between looks at the disk for what others wrote."""

Body = dict[str, Any]


class Json(JSONResponse):
    """JSON as the rest of the package writes it."""

    def render(self, content: Any) -> bytes:
        return compact_json(content).encode()


def web_app(session: Session, door: Door) -> ASGIApp:
    """The application of a review. It loads the agents when it starts."""

    @contextlib.asynccontextmanager
    async def running(_app: Starlette) -> AsyncIterator[None]:
        session.planning.start()
        looking = asyncio.create_task(_look(session))
        try:
            yield
        finally:
            looking.cancel()
            session.planning.stop()
            session.events.close()

    handlers: dict[Any, ExceptionHandler] = {
        HTTPException: _http_problem,
        PlannerError: _problem,
        ClientDisconnect: _gone,
        Exception: _bug,
    }
    app = Starlette(
        routes=[*_page_routes(door), *_api_routes(session)],
        exception_handlers=handlers,
        lifespan=running,
    )
    # Outside of everything, so that also what goes wrong inside is answered with its headers.
    return Guard(app, door)


async def _look(session: Session) -> None:
    while True:
        await asyncio.sleep(LOOK_EVERY)
        await run_in_threadpool(session.look)


# ---------------------------------------------------------------- the page


def _page_routes(door: Door) -> list[Route]:
    async def index(request: Request) -> Response:
        if door.keys.opens(request.query_params.get("token", "")):
            answer = RedirectResponse("/", 303)
            answer.set_cookie(
                door.cookie, door.keys.session, httponly=True, samesite="strict", path="/"
            )
            return answer
        if not door.admits(request):
            return PlainTextResponse(ASK_THE_TERMINAL + "\n", 403)
        return Response((PAGE / "index.html").read_bytes(), media_type="text/html")

    return [Route("/", index), Route("/static/{name:path}", _static)]


async def _static(request: Request) -> Response:
    # The name is looked up among the files that there are and never put into a path.
    files = {
        file.relative_to(PAGE).as_posix(): file for file in PAGE.rglob("*") if file.suffix in TYPES
    }
    file = files.get(request.path_params["name"])
    if file is None:
        raise HTTPException(404)
    return Response(file.read_bytes(), media_type=TYPES[file.suffix])


# ---------------------------------------------------------------- the interface


def _api_routes(session: Session) -> list[Route]:
    async def state(_request: Request) -> Response:
        return Json(await run_in_threadpool(session.state))

    async def events(_request: Request) -> Response:
        return StreamingResponse(session.events.listen(), media_type="text/event-stream")

    def change(path: str, make: Callable[[Body], Any]) -> Route:
        """What is asked for with POST: 200 with the state that it leads to, 202 when the agents are
        at work on it.
        """

        async def answer(request: Request) -> Response:
            body = await _body(request)
            try:
                after = await run_in_threadpool(make, body)
            except ChangedError as error:
                return Json(
                    {"error": str(error), "state": await run_in_threadpool(session.state)}, 409
                )
            return Json({}, 202) if after is None else Json(after)

        return Route(path, answer, methods=["POST"])

    return [
        Route("/api/state", state),
        Route("/api/events", events),
        change("/api/plan", lambda body: session.plan(_text(body, "command"), _locations(body))),
        change(
            "/api/edit", lambda body: session.edit(_text(body, "revision"), _object(body, "edit"))
        ),
        change("/api/undo", lambda body: session.undo(_text(body, "revision"))),
        change(
            "/api/skills", lambda body: session.skills(_text(body, "revision"), _text(body, "task"))
        ),
        change(
            "/api/approve",
            lambda body: session.approve(
                _text(body, "revision"), _text(body, "name"), _texts(body, "acknowledged")
            ),
        ),
        change(
            "/api/reject",
            lambda body: session.reject(
                _text(body, "revision"), _text(body, "name"), _text(body, "reason")
            ),
        ),
        change("/api/open", lambda body: session.open(_text(body, "path"))),
    ]


async def _body(request: Request) -> Body:
    """The object that a request holds. Never more than LARGEST_BODY is kept of it, whatever its
    length was said to be.
    """
    data = bytearray()
    async for part in request.stream():
        data += part
        if len(data) > LARGEST_BODY:
            raise HTTPException(413, too_large())
    try:
        value, _line, problem = decode_json(data.decode())
    except UnicodeDecodeError:
        value, problem = None, "not UTF-8 text"
    if problem is not None or not isinstance(value, dict):
        raise PlannerError(f"the request is {problem or 'no JSON object'}")
    return value


def _text(body: Body, key: str) -> str:
    value = body.get(key)
    if not isinstance(value, str):
        raise PlannerError(f"{key} must be a text")
    return value


def _texts(body: Body, key: str) -> list[str]:
    value = body.get(key)
    if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
        raise PlannerError(f"{key} must be a list of texts")
    return value


def _object(body: Body, key: str) -> Body:
    value = body.get(key)
    if not isinstance(value, dict):
        raise PlannerError(f"{key} must be an object")
    return value


def _locations(body: Body) -> dict[str, tuple[float, float]]:
    """The positions of places, by name."""
    given = body.get("locate") or {}
    if not isinstance(given, dict) or not all(_is_position(value) for value in given.values()):
        raise PlannerError(
            "locate must be an object of names with positions [x, y] in metres east and north of"
            " home"
        )
    return {name: (value[0], value[1]) for name, value in given.items()}


def _is_position(value: Any) -> bool:
    return (
        isinstance(value, list)
        and len(value) == 2
        and all(type(item) in (int, float) and math.isfinite(item) for item in value)
    )


# ---------------------------------------------------------------- what goes wrong

SENTENCES = {
    404: "There is nothing at this address.",
    405: "This address does not answer that method.",
}


async def _http_problem(_request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    return Json({"error": SENTENCES.get(error.status_code, error.detail)}, error.status_code)


async def _problem(_request: Request, error: Exception) -> Response:
    if isinstance(error, UnacknowledgedError):
        return Json(
            {
                "error": (
                    f"{len(error.missing)} warnings are not acknowledged; read each of them and"
                    " acknowledge it."
                ),
                "missing": list(error.missing),
            },
            422,
        )
    return Json({"error": str(error)}, 409 if isinstance(error, BusyError) else 422)


async def _gone(_request: Request, _error: Exception) -> Response:
    return Response(status_code=400)


async def _bug(_request: Request, error: Exception) -> Response:
    return Json(
        {"error": f"The program made a mistake ({type(error).__name__}); nothing was changed."}, 500
    )
