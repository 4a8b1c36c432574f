"""run_case.py PROGRAM FILE CASE: runs one test_ function of FILE against the program.

Exit status 77 means skipped: the case printed what is missing.
"""
import runpy
import sys

runpy.run_path(sys.argv[2])[sys.argv[3]]()
