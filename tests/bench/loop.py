"""How punctual the loop's process is on the emulated rig, beside a server with clients.

    python -m tests.bench.loop [SECONDS] [CLIENTS]

Prints lateness, cost of a tick, skipped ticks and memory of the loop's process. The rig runs
in wall-clock time; its own process is starved by a loop of real-time priority on few cores, so
its own lateness shows as ages of the feedback.
"""
