#!/usr/bin/env python3
"""The tables of docs/node_api.md say what a running node shows to others: no more and no less, with these types."""

import re
import sys
import threading
import unittest
from pathlib import Path

import rosgraph
import rospy
import rosservice
import rostest
import yaml
from dynamic_reconfigure.msg import ConfigDescription
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

PATIENCE = 60  # s of wall time
PAGE = Path(__file__).resolve().parents[2] / "docs" / "node_api.md"
# What every node of roscpp has.
ROSCPP = {"/rosout"}
ROSCPP_SERVICES = {"get_loggers", "set_logger_level"}


def rows(heading):
    """The cells of the table below a heading, without the marks of code."""
    return [[cell.replace("`", "") for cell in cells] for cells in marked_rows(heading)]


def marked_rows(heading):
    lines = [line for line in section(heading).splitlines() if line.startswith("| `")]
    return [[cell.strip() for cell in line.strip("|").split(" | ")] for line in lines]


def section(heading):
    return PAGE.read_text().split(f"\n## {heading}\n")[1].split("\n## ")[0]


def marked(text):
    return re.findall(r"`(\w+)`", text)


class NodeApi(unittest.TestCase):
    def setUp(self):
        self.node = "/sensory_growth"
        self.organ = rospy.get_param("/test_organ")
        rospy.wait_for_service(self.node + "/step", PATIENCE)
        self.master = rosgraph.Master(rospy.get_name())
        self.publications, self.subscriptions, self.services = self.master.getSystemState()

    def names(self, of):
        return {name for name, nodes in of if self.node in nodes}

    def resolve(self, name):
        name, _, mark = name.partition(" ")
        if mark == "(relative)":
            return "/" + name
        return name.replace("~", self.node + "/").replace("<id>", self.organ)

    def check_topics(self, heading, shown):
        table = {self.resolve(cells[0]): cells[1] for cells in rows(heading)}
        self.assertEqual(set(table), shown)
        types = dict(self.master.getTopicTypes())
        self.assertEqual(table, {topic: types[topic] for topic in table})

    def test_topics_out(self):
        self.check_topics("Topics out", self.names(self.publications) - ROSCPP)

    def test_topics_in(self):
        own = {"/tf", "/tf_static", "/clock"}  # heard by the listener of tf2 and by roscpp itself
        self.check_topics("Topics in", self.names(self.subscriptions) - own)

    def test_services(self):
        table = {self.resolve(cells[0]): cells[1] for cells in rows("Services")}
        shown = {name for name in self.names(self.services) if name.split("/")[-1] not in ROSCPP_SERVICES}
        self.assertEqual(set(table), shown)
        self.assertEqual(table, {service: rosservice.get_service_type(service) for service in table})

    def test_what_services_take(self):
        for service, _, takes, _ in marked_rows("Services"):
            kind = rosservice.get_service_class_by_name(self.resolve(service.strip("`")))
            self.assertEqual(marked(takes), kind._request_class.__slots__, service)

    def test_live_parameters(self):
        told = marked(section("Live parameters").split(" may")[0])
        shown = rospy.wait_for_message(self.node + "/parameter_descriptions", ConfigDescription, PATIENCE)
        self.assertEqual(set(told), {parameter.name for group in shown.groups for parameter in group.parameters})

    def test_what_is_latched(self):
        unasked = {"/clock", "/diagnostics", "~stimulus_handles/update"}  # come by themselves again and again
        for topic, _, is_latched, _, _ in rows("Topics out"):
            if topic in ("/tf_static", "~checkpoint"):  # others may latch the one, and the other comes with a load
                continue
            if is_latched == "yes" or topic in unasked:
                message = rospy.wait_for_message(self.resolve(topic), rospy.AnyMsg, PATIENCE)
                self.assertEqual(message._connection_header["latching"], "1" if is_latched == "yes" else "0", topic)

    def test_parameters(self):
        table = {cells[0].strip("~") for cells in rows("Parameters")}
        effective = rospy.wait_for_message(self.node + "/parameters", String, PATIENCE)
        self.assertEqual(table, set(yaml.safe_load(effective.data)) - {"version", "node"})

    def test_frames(self):
        table = {}
        for name, parent, moves, _ in rows("Frames"):
            for station in "12":  # ~stations of this test
                frame = name.replace("<prefix>", "pot/").replace("<id>", self.organ).replace("<k>", station)
                table[frame] = (parent.replace("the world", "soil"), moves)
        shown = {}
        complete = threading.Event()

        def hear(message, moves):
            shown.update({t.child_frame_id: (t.header.frame_id, moves) for t in message.transforms})
            if set(shown) >= set(table):
                complete.set()

        moving = rospy.Subscriber("/tf", TFMessage, hear, "yes")
        rospy.Subscriber("/tf_static", TFMessage, hear, "no")
        step = rospy.ServiceProxy(self.node + "/step", rosservice.get_service_class_by_name(self.node + "/step"))
        for _ in range(100):  # until the connection stands
            step(1)
            if complete.wait(0.1):
                break
        moving.unregister()
        self.assertEqual(shown, table)


if __name__ == "__main__":
    rospy.init_node("node_api")
    rostest.rosrun("sensory_growth", "node_api", NodeApi, sys.argv)
