"""Runs the command supple."""

import os
import shutil
import subprocess

from . import settings

# Pictures of large characters on a device that is a CPU take a while; nothing takes this long.
TIMEOUT_SECONDS = 600


class CommandError(Exception):
    """Why the command gave nothing, in its own words."""


def find():
    for path in (settings.command_path(), os.environ.get("SUPPLE_COMMAND"), shutil.which("supple")):
        if path and os.path.isfile(path):
            return path
    raise CommandError("The command supple is not in PATH: say in the preferences of this add-on where it is")


def run(arguments):
    """What it prints; its warnings, a line each."""
    try:
        done = subprocess.run([find()] + arguments, capture_output=True, text=True, errors="replace",
                              timeout=TIMEOUT_SECONDS, check=False)
    except (OSError, subprocess.TimeoutExpired) as reason:
        raise CommandError(str(reason)) from reason
    if done.returncode != 0:
        raise CommandError(done.stderr.strip() or "supple ended with exit code %d" % done.returncode)
    return done.stdout, done.stderr.splitlines()
