"""Ways to damage a dataset, each with the check that must find it.

A corruption is a function of a dataset_copy.Copy, whose hashes are updated afterwards: a wrong hash
is the easy case and has its own corruption. Each *_corruptions.py adds those of one subject to ALL.
"""
ALL = []


def found_by(check):
    def keep(function):
        ALL.append((function.__name__, check, function))
        return function
    return keep
