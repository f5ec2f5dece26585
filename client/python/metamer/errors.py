"""What can go wrong, as exceptions. Codes are those of the wire (proto/PROTOCOL.md, Errors)."""
from collections.abc import Iterable

from metamer.v1 import jobs_pb2, problem_pb2, session_pb2


class MetamerError(Exception):
    """All that this package raises of its own accord."""


def located(problem: problem_pb2.Problem) -> str:
    """A problem as one line: where, and what."""
    where = problem.file
    if problem.line:
        where += f":{problem.line}"
        if problem.column:
            where += f":{problem.column}"
    return ": ".join(part for part in (where, problem.field, problem.message) if part)


def _with_problems(message: str, problems: list[problem_pb2.Problem]) -> str:
    return "\n".join(filter(None, [message, *map(located, problems)]))


class InputError(MetamerError):
    """What was asked can't be: a scene that is no scene, a file that is not there, an address that is none.
    `problems` has a problem_pb2.Problem for each fault; may be empty."""

    def __init__(self, message: str, problems: Iterable[problem_pb2.Problem] = ()) -> None:
        self.problems = list(problems)
        super().__init__(_with_problems(message, self.problems))


class NoServer(MetamerError):
    """No server is there, none could be started, or it is not to be trusted."""


class Disconnected(MetamerError):
    """The connection is lost. Jobs go on; a watch can be continued by a new session from the last number seen."""


class ProtocolError(MetamerError):
    """The server says what cannot be. The connection is not to be used any longer."""


class JobFailed(MetamerError):
    """A job ended FAILED: `kind` ("BAD_INPUT", "WORKER", "SERVER"), `reason`, `problems`."""

    def __init__(self, job_id: int, failed: jobs_pb2.Failed) -> None:
        self.job_id = job_id
        self.kind = jobs_pb2.Failed.Kind.Name(failed.kind)
        self.reason = failed.reason
        self.problems = list(failed.problem)
        super().__init__(_with_problems(f"job {job_id} failed: {failed.reason}", self.problems))


class JobCancelled(MetamerError):
    """A job was cancelled, by whomever."""


class ViewClosed(MetamerError):
    """A view ended: `kind` as JobFailed has it ("UNSPECIFIED": it was closed), its reason, `problems`."""

    def __init__(self, failed: jobs_pb2.Failed) -> None:
        self.kind = jobs_pb2.Failed.Kind.Name(failed.kind)
        self.problems = list(failed.problem)
        super().__init__(_with_problems(failed.reason or "the view was closed", self.problems))


class ServerError(MetamerError):
    """Error from the server: `code` ("LIMIT"), `problems`. Each code has a class of its own below."""

    code = "UNSPECIFIED"

    def __init__(self, error: session_pb2.Error) -> None:
        self.code = _code_name(error.code)
        self.problems = list(error.problem)
        super().__init__(_with_problems(error.message, self.problems))


def _code_name(code: int) -> str:
    known = session_pb2.Error.Code.values()
    return session_pb2.Error.Code.Name(code) if code in known else str(code)


class VersionError(ServerError):
    """VERSION: the versions of the protocol differ; closed."""


class FrameError(ServerError):
    """FRAME: a length of 0 or too large, or bytes that are no Envelope; closed."""


class UnknownMessage(ServerError):
    """UNKNOWN_MESSAGE: an older server; the session goes on."""


class OrderError(ServerError):
    """ORDER: no Hello yet, a second one, or a chunk out of order."""


class LimitError(ServerError):
    """LIMIT: over a limit, which the message names."""


class NotFound(ServerError):
    """NOT_FOUND: no such job or view, no longer, or another user's."""


class MissingAsset(ServerError):
    """MISSING_ASSET: Submit names a digest that the store lacks."""


class DigestError(ServerError):
    """DIGEST: an asset's bytes do not have its digest."""


class StateError(ServerError):
    """STATE: the job's state does not allow it."""


class InternalError(ServerError):
    """INTERNAL: the server's fault: disk full, say."""


class Unauthenticated(ServerError):
    """UNAUTHENTICATED: who asks has not shown who he is, or no longer may come in; closed."""


class Forbidden(ServerError):
    """FORBIDDEN: the user's role does not allow it."""


class Closing(ServerError):
    """CLOSING: the server ends; with a state, jobs go on when it is back."""


SERVER_ERRORS: dict[int, type[ServerError]] = {
    session_pb2.Error.VERSION: VersionError,
    session_pb2.Error.FRAME: FrameError,
    session_pb2.Error.UNKNOWN_MESSAGE: UnknownMessage,
    session_pb2.Error.ORDER: OrderError,
    session_pb2.Error.LIMIT: LimitError,
    session_pb2.Error.NOT_FOUND: NotFound,
    session_pb2.Error.MISSING_ASSET: MissingAsset,
    session_pb2.Error.DIGEST: DigestError,
    session_pb2.Error.STATE: StateError,
    session_pb2.Error.INTERNAL: InternalError,
    session_pb2.Error.UNAUTHENTICATED: Unauthenticated,
    session_pb2.Error.FORBIDDEN: Forbidden,
    session_pb2.Error.CLOSING: Closing,
}


def server_error(error: session_pb2.Error) -> ServerError:
    """The exception of an Error; a code of a newer server is a plain ServerError."""
    return SERVER_ERRORS.get(error.code, ServerError)(error)
