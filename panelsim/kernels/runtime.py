"""The one owner of the Taichi runtime: nothing else in panelsim imports or starts Taichi.

Taichi keeps one runtime a process. Starting it a second time destroys what the first one held, and
a forked child hangs at its first kernel; both are refused here in words.
"""

import contextlib
import ctypes
import io
import os
import signal
import sys
import threading
from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np

from panelsim.errors import PanelsimError

# Read by Taichi as it is imported: no banner on standard output, no question to the network about
# newer versions, no emptying of a print buffer at every launch where standard output is captured.
ENVIRONMENT = {"ENABLE_TAICHI_HEADER_PRINT": "0", "TI_SKIP_VERSION_CHECK": "ON", "TI_ENABLE_PYBUF": "0"}

# Taichi compiles one kernel at a time, and takes another's beginning for a part of the first.
compiling = threading.RLock()

_program: Any = None  # the Taichi program that was found or made fit for the kernels
_process = 0  # the process it belongs to


@cache
def import_taichi() -> Any:
    """Import Taichi quietly; what the user's environment says about it stands."""
    for name, value in ENVIRONMENT.items():
        os.environ.setdefault(name, value)
    with compiling, interrupts_held_back():
        import taichi

    return taichi


@contextlib.contextmanager
def interrupts_held_back() -> Iterator[None]:
    """Raise an interrupt after the block: as Taichi is imported and declares kernels, it swallows them."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    held: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, frame: held.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
    if held:
        raise KeyboardInterrupt


def start() -> None:
    """Make sure that a Taichi runtime fit for the kernels is alive; costs nothing once it is.

    One CPU thread, double precision, no fast-math: IEEE results that repeat bit for bit. A runtime
    that somebody else has started is used if it computes in the same way. Raises PanelsimError if
    it does not, or if this process was forked from one that had started Taichi.
    """
    global _program, _process
    impl = import_taichi().lang.impl
    current = impl.get_runtime().prog
    if _process not in (0, os.getpid()):
        raise PanelsimError(
            "Taichi was started before this process was forked, and would hang here",
            remedy='start worker processes with multiprocessing.get_context("spawn")',
        )
    if current is not None and current is _program:
        return
    with compiling:
        if impl.get_runtime().prog is None:
            _initialise()
        _require_exact_arithmetic()
        _program, _process = impl.get_runtime().prog, os.getpid()


def _initialise() -> None:
    ti = import_taichi()
    with contextlib.redirect_stdout(io.StringIO()), _arithmetic_kept():  # it announces itself there
        ti.init(
            arch=ti.cpu,
            default_fp=ti.f64,
            fast_math=False,
            cpu_max_num_threads=1,
            offline_cache=True,
            log_level=ti.WARN,
        )
        # At once, because another thread than this one could not do it before its first kernel.
        ti.lang.impl.get_runtime().materialize()


@contextlib.contextmanager
def _arithmetic_kept() -> Iterator[None]:
    """Put the floating-point environment back afterwards.

    Taichi has the thread flush numbers below 2^-1022 to zero. That reaches all who compute there: of
    scipy's beta function it makes 0 at (171, 1/2).
    """
    library = ctypes.CDLL("ucrtbase" if sys.platform == "win32" else None)
    environment = ctypes.create_string_buffer(256)  # far more than any fenv_t
    library.fegetenv(environment)
    try:
        yield
    finally:
        library.fesetenv(environment)


def _require_exact_arithmetic() -> None:
    """Raise PanelsimError unless the live runtime computes as the kernels need it."""
    ti = import_taichi()
    config = ti.lang.impl.current_cfg()
    if (
        config.arch in (ti.x64, ti.arm64)
        and (config.default_fp, config.default_ip) == (ti.f64, ti.i32)
        and not (config.fast_math or config.debug)
    ):
        return
    raise PanelsimError(
        "A Taichi runtime with other settings is alive in this process",
        got=f"arch={config.arch}, default_fp={config.default_fp}, default_ip={config.default_ip}, "
        f"fast_math={config.fast_math}, debug={config.debug}",
        allowed="arch=cpu, default_fp=f64, default_ip=i32, fast_math=False, debug=False",
        remedy="let panelsim start Taichi first, pass these settings to ti.init, or use another process; "
        "TI_ARCH, TI_DEFAULT_FP and TI_FAST_MATH in the environment must not say otherwise",
    )


class Launch:
    """A call of a Taichi kernel with the same arguments every time, at a fiftieth of the usual cost.

    The usual call looks up the types and addresses of its arguments anew, some 60 µs for ten of them: as
    much as a force. Arguments are contiguous NumPy arrays, which are read and written where they are,
    integers, and values of template arguments.
    """

    def __init__(self, kernel: Any, *arguments: Any) -> None:
        self._kernel, self._arguments = kernel, arguments  # the arrays must outlive the context
        self._program: Any = None

    def __call__(self) -> None:
        """Run the kernel; raises PanelsimError as `start` does."""
        start()
        if self._program is not _program:  # at first, or another runtime since
            with compiling, interrupts_held_back():
                self._prepare()
        self._program.launch_kernel(self._compiled, self._context)

    def _prepare(self) -> None:
        """Compile the kernel, and write down its arguments as Taichi's own call does."""
        ti = import_taichi()
        primal = self._kernel._primal
        handle = primal.compiled_kernels[primal.ensure_compiled(*self._arguments)]
        self._context = handle.make_launch_context()
        passed = [
            (argument.annotation, value)
            for argument, value in zip(primal.arguments, self._arguments, strict=True)
            if not isinstance(argument.annotation, ti.template)
        ]
        for place, (annotation, value) in enumerate(passed):
            if isinstance(value, np.ndarray):
                elements = value.ndim - annotation.ndim  # a row of eight is one element
                shape = value.shape[: value.ndim - elements]
                self._context.set_arg_external_array_with_shape(
                    (place,), value.ctypes.data, value.nbytes, shape, 0
                )
            else:
                self._context.set_arg_int((place,), int(value))
        config, capabilities = _program.config(), _program.get_device_caps()
        self._compiled = _program.compile_kernel(config, capabilities, handle)
        self._program = _program
