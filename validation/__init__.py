"""Runs the cases of docs/validation.md through the public interfaces and compares them with figures of other origin."""
