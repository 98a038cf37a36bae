"""Attacks by processes, threads, signals, identities and priorities. See `memory`."""

import os
import resource
import subprocess
import threading
import time


def fork(clue):
    number = os.fork()
    if number == 0:
        os._exit(0)
    os.waitpid(number, 0)
    return b"forked"


def bomb(clue):
    made = 0
    for _ in range(200):
        if os.fork() == 0:
            time.sleep(3.0)
            os._exit(0)
        made += 1
    return str(made).encode()


def start_a_thread(clue):
    thread = threading.Thread(target=int)
    thread.start()
    thread.join()
    return b"started"


def become_a_shell(clue):
    os.execv("/bin/sh", ["sh", "-c", "exit 3"])


def become_an_interpreter(clue):
    import sys

    os.execv(sys.executable or "/usr/bin/python3", ["python", "-c", "pass"])


def start_a_program(clue):
    return subprocess.run(["/bin/cat", clue["file"]], capture_output=True, check=True).stdout


def start_without_forking(clue):
    return str(os.posix_spawn("/bin/true", ["true"], {})).encode()


def signal_the_asker(clue):
    os.kill(clue["pid"], 0)
    return b"signalled"


def signal_all(clue):
    os.kill(-1, 9)
    return b"signalled"


def stop_its_keeper(clue):
    os.kill(1, 19)
    return b"stopped"


def become_root(clue):
    os.setresuid(0, 0, 0)
    return b"root"


def take_another_group(clue):
    os.setgroups([0])
    return b"group"


def lift_its_limits(clue):
    try:
        resource.setrlimit(resource.RLIMIT_CPU, (1000, 1000))
    except ValueError as error:
        raise PermissionError(str(error)) from None
    return b"lifted"


def overtake_the_lab(clue):
    os.setpriority(os.PRIO_PROCESS, 0, -10)
    return b"faster"


def take_the_processor_for_good(clue):
    os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(50))
    return b"real time"


def leave_a_core(clue):
    os.abort()
