"""Counts test cases in the JUnit files of a catkin build and prints the failed ones and one closing line.

Usage: count_tests.py RESULTS_DIR CTEST_EXIT_CODE
"""

import pathlib
import sys
import xml.etree.ElementTree as ElementTree


def cases(path):
    """Yields (name, failed) of every case in a JUnit file."""
    for case in ElementTree.parse(path).getroot().iter("testcase"):
        if case.find("skipped") is None and case.get("status") != "notrun":
            name = ".".join(filter(None, (case.get("classname"), case.get("name"))))
            yield name, case.find("failure") is not None or case.find("error") is not None


def count(results_dir):
    """Returns the number of passed cases and the names of the failed ones.

    catkin leaves a MISSING-... file with one failed case for a test that wrote no results. The file of a rostest
    repeats the passes of the test nodes, which have files of their own (rosunit-...), so that only its failures count.
    """
    passed, failed = 0, []
    for path in sorted(results_dir.rglob("*.xml")):
        try:
            outcome = list(cases(path))
        except ElementTree.ParseError as error:
            failed.append(f"{path.name}: {error}")
            continue
        failed += [f"{path.stem}: {name}" for name, is_failed in outcome if is_failed]
        if not path.name.startswith("rostest-"):
            passed += sum(not is_failed for _, is_failed in outcome)
    return passed, failed


def main():
    passed, failed = count(pathlib.Path(sys.argv[1]))
    if sys.argv[2] != "0" and not failed:
        failed.append("a test program ended badly although none of its cases failed; see above")
    for name in failed:
        print("FAILED", name)
    if not passed and not failed:
        print("no test ran")
    print(f"{passed} passed, {len(failed)} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
