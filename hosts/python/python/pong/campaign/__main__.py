"""`python -m pong.campaign`: what a campaign says, and one of its runs again."""

import argparse
import sys

from pong import PongError

from . import failures, indices, repeat, summary


def main():
    parser = argparse.ArgumentParser(prog="python -m pong.campaign", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    told = commands.add_parser("summary", help="shares and quantiles with their intervals")
    told.add_argument("folder")
    told.add_argument("--confidence", type=float, default=0.95)
    sensitive = commands.add_parser("indices", help="sensitivity indices with their intervals, of the methods sobol and morris")
    sensitive.add_argument("folder")
    sensitive.add_argument("--quantity", action="append", help="column of the results; all peak loads without it")
    sensitive.add_argument("--confidence", type=float, default=0.95)
    failed = commands.add_parser("failures", help="the runs that did not come to their end")
    failed.add_argument("folder")
    again = commands.add_parser("repeat", help="one run again, in this process")
    again.add_argument("folder")
    again.add_argument("run", type=int)
    again.add_argument("--log", help="folder for its response log")
    arguments = parser.parse_args()
    try:
        if arguments.command == "summary":
            print(summary(arguments.folder, confidence=arguments.confidence))
        elif arguments.command == "indices":
            print(indices(arguments.folder, quantities=arguments.quantity, confidence=arguments.confidence))
        elif arguments.command == "failures":
            for row in failures(arguments.folder):
                print(f"run {row['run']}: {row['error']}: {row['message']}")
        else:
            for name, value in repeat(arguments.folder, arguments.run, log=arguments.log).items():
                print(f"{name}: {value}")
    except PongError as error:
        sys.exit(str(error))


if __name__ == "__main__":
    main()
