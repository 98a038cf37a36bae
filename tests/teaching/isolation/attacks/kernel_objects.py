"""Attacks on the kernel's own memory, which no limit of a process includes. See `memory`."""

import ctypes
import os
import select

libc = ctypes.CDLL(None, use_errno=True)
MANY = 20_000
"""So many folders took 25 MB of the kernel."""
LIMIT = 100


def repeat(make):
    """Make many objects; return how many there are, unless they are within the limit."""
    for count in range(MANY):
        try:
            make(count)
        except OSError:
            if count <= LIMIT:
                raise
            return str(count).encode()
    return str(MANY).encode()


def check(result):
    if result < 0:
        raise OSError(ctypes.get_errno(), "refused")
    return result


def make_folders(clue):
    return repeat(lambda number: os.mkdir(f"{number}"))


def make_folders_in_folders(clue):
    return repeat(lambda _: (os.mkdir("deeper"), os.chdir("deeper")))


def make_empty_files(clue):
    return repeat(lambda number: os.close(os.open(f"{number}", os.O_CREAT | os.O_WRONLY)))


def make_long_names(clue):
    return repeat(lambda number: open(f"{number:0255}", "x").close())


def make_links(clue):
    return repeat(lambda number: os.symlink("x" * 4000, f"{number}"))


def make_names_of_its_own_file(clue):
    return repeat(lambda number: os.link("/lab/law.py", f"{number}"))


def make_files_in_turn(clue):
    """Make and remove many files, so that one removed file does not make room for two."""
    for number in range(MANY):
        os.close(os.open("file", os.O_CREAT | os.O_WRONLY))
        os.rename("file", f"{number % 2}")
        if number % 2:
            os.remove("0")
            os.remove("1")
    return repeat(lambda number: os.mkdir(f"{number}"))


def keep_removed_files(clue):
    """Keep removed files open: they have no name, but take memory."""
    files = []
    for number in range(MANY):
        try:
            files.append(os.open("file", os.O_CREAT | os.O_WRONLY))
        except OSError:
            if number <= LIMIT:
                raise
            break
        os.remove("file")
    return str(len(files)).encode()


def raise_the_limit(clue):
    remount = 32
    check(libc.mount(b"tmpfs", b"/work", b"tmpfs", remount | 6, b"nr_inodes=0"))
    return repeat(lambda number: os.mkdir(f"{number}"))


def make_named_pipes(clue):
    return repeat(lambda number: os.mkfifo(f"{number}"))


def make_attributes(clue):
    return repeat(lambda number: os.setxattr(".", f"user.{number}", bytes(4000)))


def make_pipes(clue):
    return repeat(lambda _: os.pipe())


def make_counters(clue):
    return repeat(lambda _: os.eventfd(0))


def make_pollers(clue):
    return repeat(lambda _: select.epoll())


def make_watches(clue):
    return repeat(lambda _: check(libc.inotify_init1(0)))


def make_clocks(clue):
    return repeat(lambda _: check(libc.timerfd_create(1, 0)))


def make_timers(clue):
    timer = ctypes.c_void_p()
    return repeat(lambda _: check(libc.timer_create(1, None, ctypes.byref(timer))))


def make_message_queues(clue):
    return repeat(lambda _: check(libc.msgget(0, 0o1600)))


def make_semaphores(clue):
    return repeat(lambda _: check(libc.semget(0, 250, 0o1600)))


def lock_files(clue):
    file = os.open("/lab/law.py", os.O_RDONLY)
    return repeat(lambda number: os.lockf(file, os.F_LOCK, number))
