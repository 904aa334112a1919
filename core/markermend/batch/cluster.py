"""Jobs on a Dask cluster: many machines that see the same folders."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, Any

import markermend as mm
from markermend.batch.pool import Message
from markermend.batch.work import why
from markermend.errors import MarkermendError, MethodError
from markermend.progress import Progress, quiet

if TYPE_CHECKING:
    from distributed import Client

_CONNECT_S = 10.0


@contextmanager
def connected(cluster: str | Client) -> Iterator[Client]:
    """Client of a cluster, closed in the end unless it was given.

    Parameters
    ----------
    cluster : address of the scheduler (``"tcp://host:8786"``), or a client of it

    Raises
    ------
    MethodError
        when Dask is not installed
    MarkermendError
        when nobody answers at the address
    """
    try:
        from distributed import Client
    except ImportError as error:
        raise MethodError(
            'A cluster needs Dask; install it with: python -m pip install "markermend[cluster]"'
        ) from error
    if not isinstance(cluster, str):
        yield cluster
        return
    try:
        client = Client(cluster, timeout=_CONNECT_S)
    except (OSError, ValueError) as error:
        raise MarkermendError(f"No cluster answers at “{cluster}”: {error}.") from error
    with client:
        yield client


def run_on_cluster(
    jobs: Sequence[Any], work: Callable[[Any, Progress], Any], client: Client
) -> Generator[Message, None, None]:
    """Do jobs on a cluster.

    The scheduler gives the job of a worker that is lost to another, as often as its own setting
    ``distributed.scheduler.allowed-failures`` says.

    Parameters
    ----------
    jobs : can be pickled; takes are named by path, so each worker must see the same folders
    work : function of a module, called with a job and a progress function
    client : of the cluster

    Yields
    ------
    Message
        ``"done"`` or ``"failed"``, in the order in which jobs end. Closing the generator takes
        back what has not begun.
    """
    from distributed import as_completed

    with ExitStack() as stack:
        # Not pure: a job is done for what it writes, even if Dask knows its result already.
        futures = {
            client.submit(alone, work, job, mm.__version__, pure=False, priority=-number): number
            for number, job in enumerate(jobs)
        }
        stack.callback(client.cancel, list(futures))
        for future in as_completed(futures):
            what, result = "failed", "The cluster lost it; run the batch again with --resume."
            if future.status == "finished":
                what, result = future.result()
            elif future.status == "error":
                result = f"The cluster gave it up ({type(future.exception()).__name__})."
            yield Message(futures[future], what, 1.0, result=result)
            # What is known to be over need not be remembered by the scheduler.
            future.release()


def alone(work: Callable[[Any, Progress], Any], job: Any, version: str) -> tuple[str, Any]:
    """Do one job on a worker, turning what stops it into a sentence.

    Parameters
    ----------
    work, job : as for :func:`run_on_cluster`
    version : Markermend's, where the batch was started

    Returns
    -------
    ``("done", result)`` or ``("failed", sentence)``
    """
    if version != mm.__version__:
        return "failed", f"A worker of the cluster has Markermend {mm.__version__}, not {version}."
    try:
        return "done", work(job, quiet)
    except Exception as error:
        return "failed", why(error)
