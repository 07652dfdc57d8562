"""`python -m panelsim`: the command line."""

from panelsim.cli import main

if __name__ == "__main__":
    main()
