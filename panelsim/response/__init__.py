"""The linear ship in the frequency domain: transfer functions, and what they make of a sea.

The package bears the name of its main function, `panelsim.response(...)`. Whichever of the two is imported
first, that call works: a package that is called passes the call on.
"""

import sys
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from panelsim.response.response import Response


class _CallablePackage(ModuleType):
    def __call__(self, *arguments: Any, **named: Any) -> "Response":
        from panelsim.response.response import response

        return response(*arguments, **named)


sys.modules[__name__].__class__ = _CallablePackage
