# SPDX-License-Identifier: GPL-3.0-or-later
"""Who is who among the processes, and how a script starts and ends on all of them."""
import os
import signal
import sys
import traceback

# Ranks that wait spin, and with more ranks than cores keep the working ones from theirs (measured: a run 30 times
# as long). MPI reads this when it starts, which importing mpy makes it do.
os.environ.setdefault("OMPI_MCA_mpi_yield_when_idle", "1")

try:
    from yade import mpy
except ImportError as error:
    raise ImportError(
        f"potential_particles.mpi needs YADE's module mpy and mpi4py (Debian package python3-mpi4py): {error}"
    ) from error

# Of mpy only what concerns the end of a run would be printed, once a rank.
mpy.NO_OUTPUT = True

_stop_asked = False


def rank():
    """Number of this process, from 0; rank 0 holds the bodies that do not move."""
    return mpy.comm.Get_rank()


def ranks():
    """Number of processes."""
    return mpy.comm.Get_size()


def gather(value):
    """The values of all ranks, in their order, on rank 0; None elsewhere. Collective."""
    return mpy.comm.gather(value, root=0)


def share(value):
    """The value of rank 0, on all ranks. Collective."""
    return mpy.comm.bcast(value, root=0)


def interrupted():
    """Whether any rank was asked to stop by SIGINT or SIGUSR1 since `launch`. Collective: all ranks get the same
    answer.
    """
    return bool(mpy.comm.allreduce(int(_stop_asked), op=mpy.MPI.MAX))


def launch(main):
    """Calls main() on every rank, and ends the script so that no rank waits for one that has failed.

    An exception on any rank ends the run on all of them, with its message and exit status 1 (or that of a SystemExit).
    SIGINT and SIGUSR1 end nothing by themselves: `interrupted` reports them. mpirun passes SIGUSR1 on to its ranks and
    answers SIGINT by ending them; scripts/yade_mpi.sh passes SIGINT on as SIGUSR1.
    """
    for number in (signal.SIGINT, signal.SIGUSR1):
        signal.signal(number, _ask_to_stop)
    try:
        main()
    except SystemExit as end:
        if end.code not in (None, 0):
            message = "" if isinstance(end.code, int) else str(end.code)
            _abort(message, end.code if isinstance(end.code, int) else 1)
    except BaseException:
        _abort(traceback.format_exc(), 1)
    # YADE's own end of a script gives ranks that are still at work a minute.
    mpy.comm.Barrier()


def _ask_to_stop(number, frame):
    global _stop_asked
    _stop_asked = True


def _abort(message, code):
    sys.stdout.flush()
    if message:
        where = f"rank {rank()}: " if ranks() > 1 else ""
        os.write(2, f"{where}{message.rstrip()}\n".encode())
    if ranks() == 1:
        sys.exit(code)
    mpy.comm.Abort(code)
