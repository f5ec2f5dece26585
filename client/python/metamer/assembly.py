"""What a job's events make: its picture, and with them its factors."""
from metamer.errors import JobCancelled, JobFailed, ProtocolError
from metamer.events import Event, Tile
from metamer.factors import FactorsBuilder
from metamer.picture import Film, Picture
from metamer.v1 import jobs_pb2


class Assembly:
    """From one Planned on; another one makes all anew."""

    def __init__(self, planned: jobs_pb2.Planned) -> None:
        self.plan = planned.plan
        self.film = Film(self.plan.width, self.plan.height)
        self._factors = FactorsBuilder(self.plan, planned.factors) if planned.factors else None

    def put(self, tile: Tile) -> None:
        """ProtocolError: it does not fit."""
        self.film.put(tile)
        if self._factors and tile.factors:
            self._factors.add(tile)
        else:
            self._factors = None  # the picture has more of them than a server keeps

    def picture(self, job_id: int, finished: jobs_pb2.Finished) -> Picture:
        accuracy = finished.accuracy if finished.HasField("accuracy") else None
        factors = self._factors.finish() if self._factors else None
        record = finished.record if finished.HasField("record") else None
        return Picture(job_id, self.film.xyz, self.plan, finished.timing, accuracy, factors, record)


def finished_of(event: Event) -> jobs_pb2.Finished:
    """What the last event says. JobFailed, JobCancelled."""
    if event.kind == "failed":
        raise JobFailed(event.job_id, event.body)
    if event.kind == "cancelled":
        raise JobCancelled(f"job {event.job_id} was cancelled")
    if event.kind != "finished":
        raise ProtocolError(f"a job ends with {event.kind}")
    return event.body
