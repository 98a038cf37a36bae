"""The system calls that an isolated law may use: those that an interpreter needs to compute.

All others fail with EPERM: sockets, new processes and threads, exec, signals, mounts, ptrace,
keyrings, shared memory, other identities, and system calls of future kernels.
"""

import tempfile
from functools import cache

from svsa.teaching.isolation.refusal import NotIsolatedError

ALLOWED = (
    # memory
    "brk", "mmap", "munmap", "mremap", "mprotect", "madvise",
    # files: those that are mounted read-only, and those of the law's own small folder
    "read", "readv", "pread64", "write", "writev", "pwrite64", "close", "lseek", "dup",
    "open", "openat", "stat", "lstat", "fstat", "newfstatat", "statx", "access", "faccessat",
    "faccessat2", "readlink", "readlinkat", "getcwd", "getdents64", "ftruncate", "unlink",
    "unlinkat", "mkdir", "mkdirat", "rmdir", "rename", "renameat", "umask",
    # the law's own thread, and time
    "futex", "set_robust_list", "rseq", "rt_sigaction", "rt_sigprocmask", "rt_sigreturn",
    "sigaltstack", "restart_syscall", "exit", "exit_group", "gettid", "getpid", "getppid",
    "getuid", "geteuid", "getgid", "getegid", "getrusage", "getrlimit", "sched_yield",
    "sched_getaffinity", "clock_gettime", "clock_getres", "gettimeofday", "time", "nanosleep",
    "clock_nanosleep", "getrandom", "uname", "sysinfo", "poll", "ppoll", "select", "pselect6",
)  # fmt: skip
_TCGETS, _FIOCLEX = 0x5401, 0x5451
_F_GETFD, _F_SETFD, _F_GETFL, _F_DUPFD_CLOEXEC = 1, 2, 3, 1030
_COMMANDS = {
    "ioctl": (_TCGETS, _FIOCLEX),
    "fcntl": (_F_GETFD, _F_SETFD, _F_GETFL, _F_DUPFD_CLOEXEC),
}
"""Calls with many functions: permitted only with these as second argument."""


@cache
def compile_filter() -> bytes:
    """Compile the filter as a BPF program for this machine's processor.

    Raises:
        NotIsolatedError: If libseccomp is missing.
    """
    try:
        import pyseccomp
    except (ImportError, OSError, RuntimeError) as error:
        raise NotIsolatedError(f"system calls cannot be filtered ({error})") from None
    refused = pyseccomp.SyscallFilter(pyseccomp.ERRNO(1))
    for name in ALLOWED:
        number = find_number(name)
        if number is not None:
            refused.add_rule(pyseccomp.ALLOW, number)
    for name, commands in _COMMANDS.items():
        for command in commands:
            second = pyseccomp.Arg(1, pyseccomp.EQ, command)
            refused.add_rule(pyseccomp.ALLOW, name, second)
    # The C library also reads limits by `prlimit64`, with NULL in place of new ones.
    reading = pyseccomp.Arg(2, pyseccomp.EQ, 0)
    refused.add_rule(pyseccomp.ALLOW, "prlimit64", reading)
    with tempfile.TemporaryFile() as file:
        refused.export_bpf(file)
        file.seek(0)
        return file.read()


def find_number(name: str) -> int | None:
    """Find the number of a system call; None if this processor's kernel does not have it."""
    import pyseccomp

    try:
        number = pyseccomp.resolve_syscall(pyseccomp.Arch.NATIVE, name)
    except (OSError, ValueError):
        return None
    return number if number >= 0 else None
