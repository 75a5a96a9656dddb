"""A recorded run of the live node, as a user would do it: roslaunch without a display, lights on the topic, steps and
the end by service. A process of its own, since a process has one ROS node for life."""

import argparse
import json
import os
import pathlib
import signal
import socket
import subprocess
import threading
import time

NODE = "/sensory_growth"
DEADLINE = 60.0  # wall seconds for anything that should come at once


def free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


def launch(scenario, bag, growth_time_scale):
    arguments = {
        "scenario": scenario,
        "start_paused": "true",
        "real_time_factor": 0,
        "growth_time_scale": growth_time_scale,
        "record": "true",
        "recording_directory": bag.parent,
        "recording_file": bag.name,
    }
    settings = [f"{name}:={value}" for name, value in arguments.items()]
    log = open(bag.with_suffix(".log"), "wb")  # of the launched process, which outlives this function
    command = ["roslaunch", "sensory_growth", "sim.launch", *settings]
    return subprocess.Popen(command, stdout=log, stderr=log, preexec_fn=heed_interrupts)


def heed_interrupts():
    """What a shell starts in the background ignores them until it says otherwise."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def stop(node):
    node.send_signal(signal.SIGINT)
    try:
        node.wait(DEADLINE)
    except subprocess.TimeoutExpired:
        node.terminate()
        raise


def overdue(*_):
    raise TimeoutError("the live run takes too long")


class Client:
    """Sends lights and steps, and waits for what comes of them."""

    def __init__(self):
        import rospy
        from sensory_growth.msg import AppliedCommand, LightDirection
        from sensory_growth.srv import Step, StopRecording

        self._applied = threading.Semaphore(0)
        self._message = LightDirection
        rospy.init_node("validation", anonymous=True, disable_signals=True)
        self._services = {"step": Step, "stop_recording": StopRecording}
        for name, kind in self._services.items():
            rospy.wait_for_service(f"{NODE}/{name}", DEADLINE)
            self._services[name] = rospy.ServiceProxy(f"{NODE}/{name}", kind)
        echo = rospy.Subscriber(f"{NODE}/applied_commands", AppliedCommand, lambda message: self._applied.release())
        self._lights = rospy.Publisher(f"{NODE}/light_direction", LightDirection, queue_size=10)
        self._connections = (echo, self._lights)  # what goes before there is one is lost

    def wait_for_connections(self):
        deadline = time.monotonic() + DEADLINE
        while not all(connection.get_num_connections() for connection in self._connections):
            if time.monotonic() > deadline:
                raise TimeoutError("the node does not take lights or tell what it took")
            time.sleep(0.01)

    def add_light(self, id, towards, strength):
        self.wait_for_connections()
        message = self._message(operation=self._message.ADD, id=id, strength=strength)
        message.towards.x, message.towards.y, message.towards.z = towards
        self._lights.publish(message)
        if not self._applied.acquire(timeout=DEADLINE):
            raise TimeoutError(f"light {id} was not taken")

    def step(self, steps):
        answer = self._services["step"](steps=steps)
        if not answer.success:
            raise RuntimeError(answer.message)

    def stop_recording(self):
        answer = self._services["stop_recording"]()
        if not answer.success:
            raise RuntimeError(answer.message)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenario", type=pathlib.Path)
    parser.add_argument("bag", type=pathlib.Path)
    parser.add_argument("steps", type=int)
    parser.add_argument("--lights", type=json.loads, default=[], help="id, direction and strength of each")
    parser.add_argument("--growth-time-scale", type=float, default=60.0)
    parser.add_argument("--deadline", type=float, default=0.0, help="wall seconds for all of it; 0: none")
    arguments = parser.parse_args()
    signal.signal(signal.SIGALRM, overdue)
    signal.setitimer(signal.ITIMER_REAL, arguments.deadline)
    os.environ["ROS_MASTER_URI"] = f"http://localhost:{free_port()}"
    arguments.bag.unlink(missing_ok=True)
    node = launch(arguments.scenario.resolve(), arguments.bag.resolve(), arguments.growth_time_scale)
    try:
        client = Client()
        for light in arguments.lights:
            client.add_light(*light)
        client.step(arguments.steps)
        client.stop_recording()
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        stop(node)


if __name__ == "__main__":
    main()
