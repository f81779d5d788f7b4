"""The web application: page, state, changes, events. The guard decides which requests come in."""

from __future__ import annotations

import asyncio
import contextlib
import inspect
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import Any

from starlette import responses
from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect, Request
from starlette.responses import FileResponse, JSONResponse, Response
from starlette.routing import BaseRoute, Mount, Route
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp, ExceptionHandler

from planner_ft.review.approval import UnacknowledgedError
from planner_ft.review.desk import ChangedError
from planner_ft.review.web.guard import ASK_THE_TERMINAL, LARGEST_BODY, TOO_LARGE, Door, Guard
from planner_ft.review.web.planning import BusyError
from planner_ft.review.web.session import Session
from planner_ft.support.errors import PlannerError, QuestionError
from planner_ft.support.files import decode_json
from planner_ft.vocabulary.plans import is_position

PAGE = Path(__file__).parent / "page"
LOOK_EVERY = 1.0
"""Seconds between looks at the disk for changes by others."""


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
            session.end()

    handlers: dict[Any, ExceptionHandler] = {HTTPException: _http_problem, PlannerError: _problem}
    handlers |= {ClientDisconnect: _gone, Exception: _bug}
    routes = [*_page_routes(door), *_api_routes(session)]
    app = Starlette(routes=routes, exception_handlers=handlers, lifespan=running)
    # Outside of everything, so that also internal errors are answered with its headers.
    return Guard(app, door)


async def _look(session: Session) -> None:
    while True:
        await asyncio.sleep(LOOK_EVERY)
        await run_in_threadpool(session.look)


def _page_routes(door: Door) -> list[BaseRoute]:
    async def index(request: Request) -> Response:
        if door.opens(request.query_params.get("token", "")):
            answer = responses.RedirectResponse("/", 303)
            key = door.key
            answer.set_cookie(door.cookie, key, httponly=True, samesite="strict", path="/")
            return answer
        if not door.admits(request):
            return responses.PlainTextResponse(ASK_THE_TERMINAL + "\n", 403)
        return FileResponse(PAGE / "index.html", media_type="text/html")

    return [Route("/", index), Mount("/static", StaticFiles(directory=PAGE))]


# ---------------------------------------------------------------- the interface


def _api_routes(session: Session) -> list[Route]:
    async def events(_request: Request) -> Response:
        news = session.events.listen()
        return responses.StreamingResponse(news, media_type="text/event-stream")

    def route(method: Callable[..., Any]) -> Route:
        """A method of the session whose arguments are the keys of a POST, none of a GET: 200 with
        the new state, 202 while agents work.
        """
        keys = inspect.signature(method).parameters.values()

        async def answer(request: Request) -> Response:
            body = await _body(request) if keys else {}
            values = [_field(body.get(key.name), key) for key in keys]
            try:
                after = await run_in_threadpool(method, *values)
            except ChangedError as error:
                now = await run_in_threadpool(session.state)
                return JSONResponse({"error": str(error), "state": now}, 409)
            return JSONResponse({}, 202) if after is None else JSONResponse(after)

        return Route(f"/api/{method.__name__}", answer, methods=["POST" if keys else "GET"])

    methods: list[Callable[..., Any]] = [session.state, session.runs.track, session.plan]
    methods += [session.open, session.edit, session.undo, session.skills, session.approve]
    methods += [session.reject, session.export, session.run, session.abort]
    return [Route("/api/events", events), *map(route, methods)]


async def _body(request: Request) -> dict[str, Any]:
    """The object that a request holds, of at most LARGEST_BODY bytes, whatever its header says."""
    data = bytearray()
    async for part in request.stream():
        data += part
        if len(data) > LARGEST_BODY:
            raise HTTPException(413, TOO_LARGE)
    try:
        value, _line, problem = decode_json(data.decode())
    except UnicodeDecodeError:
        value, problem = None, "not UTF-8 text"
    if problem is not None or not isinstance(value, dict):
        raise PlannerError(f"the request is {problem or 'no JSON object'}")
    return value


FIELDS: dict[str, tuple[Callable[[Any], bool], str]] = {
    "str": (lambda value: isinstance(value, str), "a text"),
    "bool": (lambda value: isinstance(value, bool), "true or false"),
    "float": (lambda value: type(value) in (int, float), "a number"),
    "Edit": (lambda value: isinstance(value, dict), "an object"),
    "list[str]": (
        lambda value: isinstance(value, list) and all(isinstance(item, str) for item in value),
        "a list of texts",
    ),
    "Locations": (
        lambda value: isinstance(value, dict) and all(map(is_position, value.values())),
        "an object of names with positions [x, y] in metres east and north of home",
    ),
}
"""Per annotation of a session's method, what its argument must be."""


def _field(value: Any, key: inspect.Parameter) -> Any:
    """The value of a key, of the type that its method takes. Raises PlannerError."""
    fits, expected = FIELDS[str(key.annotation)]
    if value is None and key.default is not key.empty:
        return key.default
    if not fits(value):
        raise PlannerError(f"{key.name} must be {expected}")
    return value


# ---------------------------------------------------------------- errors

SENTENCES = {
    404: "There is nothing at this address.",
    405: "This address does not answer that method.",
}


async def _http_problem(_request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    return JSONResponse(
        {"error": SENTENCES.get(error.status_code, error.detail)}, error.status_code
    )


async def _problem(_request: Request, error: Exception) -> Response:
    if isinstance(error, UnacknowledgedError):
        count = f"{len(error.missing)} warnings are not acknowledged"
        sentence = f"{count}; read each of them and acknowledge it."
        return JSONResponse({"error": sentence, "missing": list(error.missing)}, 422)
    more = {"question": error.question} if isinstance(error, QuestionError) else {}
    return JSONResponse({"error": str(error), **more}, 409 if isinstance(error, BusyError) else 422)


async def _gone(_request: Request, _error: Exception) -> Response:
    return Response(status_code=400)


async def _bug(_request: Request, error: Exception) -> Response:
    name = type(error).__name__
    return JSONResponse(
        {"error": f"The program made a mistake ({name}); nothing was changed."}, 500
    )
