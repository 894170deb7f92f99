"""Spaces of parameters for `swarmsmith.tune`: what Python writes as irace reads it, and back. Pure."""
import decimal
import difflib
import math
import numbers
import re
import sys

LARGEST_WHOLE = 2**53 - 1  # irace's values are doubles
LARGEST = sys.float_info.max


class Error(Exception):
    """What cannot be done, in the program's words or in ours."""


class SpaceError(Error, ValueError):
    """A space, a condition or a configuration that cannot be."""


class OptionError(Error, ValueError):
    """An option that is not known, or a value that it cannot have."""


class CostError(Error, TypeError):
    """What a function returned is not a cost."""


def is_number(value):
    return isinstance(value, numbers.Real) and not isinstance(value, bool)


def sequence(name, value, of, kind):
    """A list of what may be a list. A text is none, since it would be split into letters."""
    if isinstance(value, (str, bytes, dict, set, frozenset)) or not hasattr(value, "__iter__"):
        raise kind(f"{name}: expected a list of {of}, found {value!r}")
    return list(value)


def plain(value):
    """A text that neither a shell nor irace's files read anything into."""
    return re.sub(r"[^A-Za-z0-9_.+-]", "_", str(value))


def _condition(when):
    if when is not None and not isinstance(when, str):
        raise SpaceError(f"when: a condition must be a text, such as 'x > 0.5', found {when!r}")
    return when


class _Choice:
    """Values of any type; `when` is a condition on other parameters, in R's words: 'kernel == "poly"'."""

    def __init__(self, values, when=None):
        self.values, self.when = sequence("values", values, "values", SpaceError), _condition(when)
        self.texts = [plain(value) for value in self.values]
        if not self.values:
            raise SpaceError("a choice needs a value")
        if len(set(self.texts)) != len(self.texts):
            raise SpaceError(f"two of the values {self.texts} have the same text: give texts that differ")

    def domain(self):
        return ", ".join(f'"{text}"' for text in self.texts)

    def value(self, text):
        return self.values[self.texts.index(str(text))]

    def text(self, value):
        if value is None and plain(None) not in self.texts:  # an inactive parameter
            return "NA"
        if plain(value) not in self.texts:
            raise SpaceError(f"{value!r} is not one of its values {self.values}")
        return f'"{plain(value)}"'


class Categorical(_Choice):
    """Values without an order. A list alone means the same."""
    letter = "c"


class Ordinal(_Choice):
    """Values in an order."""
    letter = "o"


class _Number:
    def __init__(self, lower, upper, log=False, when=None):
        self.lower, self.upper, self.log, self.when = lower, upper, log, _condition(when)
        if not isinstance(log, bool):
            raise SpaceError(f"log: expected True or False, found {log!r}")
        # A text is a bound that depends on other parameters, in R's words.
        for bound in (lower, upper):
            if not isinstance(bound, str):
                self._check(bound)
        known = [bound for bound in (lower, upper) if not isinstance(bound, str)]
        if log and (len(known) < 2 or not min(known) > 0):
            raise SpaceError(f"a logarithmic range needs two numbers above 0, found {lower!r} and {upper!r}")
        if len(known) == 2 and not lower < upper:
            raise SpaceError(f"the lower end of a range must be below the upper one, found {lower!r} and {upper!r}")

    def _check(self, number, what="the end of a range"):
        if not is_number(number) or not abs(number) <= LARGEST:
            raise SpaceError(f"{what} must be a number, and finite, found {number!r}")

    def domain(self):
        return ", ".join(bound if isinstance(bound, str) else repr(self.type(bound)) for bound in (self.lower, self.upper))

    def text(self, value):
        if value is None:  # an inactive parameter
            return "NA"
        self._check(value, "the value")
        low, high = (bound if is_number(bound) else value for bound in (self.lower, self.upper))
        if not low <= value <= high:
            raise SpaceError(f"{value!r} is not between {self.lower!r} and {self.upper!r}")
        return repr(self.type(value))

    @property
    def letter(self):
        return self.kind + (",log" if self.log else "")


class Integer(_Number):
    """Whole numbers from lower to upper; with `log` sampled in the logarithm. A tuple of two of them means the same."""
    kind, type = "i", int

    def _check(self, number, what="the end of a range"):
        super()._check(number, what)
        if number != int(number):
            raise SpaceError(f"{number!r} is not a whole number")
        if abs(number) > LARGEST_WHOLE:
            raise SpaceError(f"{number!r} is too large: whole numbers are exact up to {LARGEST_WHOLE}; tune its logarithm instead")

    def value(self, text):
        return int(text)


class Real(_Number):
    """Numbers from lower to upper; with `log` sampled in the logarithm. A tuple of two numbers means the same."""
    kind, type = "r", float

    def value(self, text):
        return float(text)

    def digits(self):
        """Decimals that show both ends, a thousand values between them, and four digits of the smallest logarithm."""
        ends = [bound for bound in (self.lower, self.upper) if not isinstance(bound, str)]
        wanted = [-decimal.Decimal(repr(float(end))).normalize().as_tuple().exponent for end in ends]
        if len(ends) == 2:
            wanted.append(3 - math.floor(math.log10(self.lower if self.log else self.upper - self.lower)))
        return max(wanted, default=0)


def domain_of(value):
    if isinstance(value, (_Choice, _Number)):
        return value
    if isinstance(value, tuple) and len(value) == 2 and all(map(is_number, value)):
        return (Integer if all(isinstance(one, numbers.Integral) for one in value) else Real)(*value)
    if isinstance(value, (list, tuple)):
        return Categorical(value)
    raise SpaceError(f"{value!r} is not a domain: a tuple of two numbers is a range, a list is a choice; "
                     "Real, Integer, Ordinal and Categorical say more")


class Space:
    """The parameters by their own names, and irace's names for them: letters, digits, "_" and "."."""

    def __init__(self, space):
        if not isinstance(space, dict) or not space:
            raise SpaceError("a space must be a dictionary of names and domains, with at least one")
        self.domains, self.names = {}, {}
        for name, value in space.items():
            if not isinstance(name, str) or not name:
                raise SpaceError(f"{name!r} is not a parameter's name: it must be a text")
            try:
                self.domains[name] = domain_of(value)
            except SpaceError as error:
                raise SpaceError(f"{name}: {error}") from None
            written = re.sub(r"[^A-Za-z0-9_.]", "_", name)
            written = written if written[0].isalpha() else "p" + written
            if written in self.names:
                raise SpaceError(f"'{self.names[written]}' and '{name}' are both {written} for irace: give names that differ in "
                                 "letters, digits, '_' or '.'")
            self.names[written] = name
        self.written = {name: written for written, name in self.names.items()}

    def digits(self):
        wanted = [(domain.digits(), name) for name, domain in self.domains.items() if isinstance(domain, Real)]
        most, name = max(wanted, default=(0, ""))
        if most > 15:
            raise SpaceError(f"{name}: it needs {most} decimals, and irace has 15: tune its logarithm instead, "
                             "such as Real(-20, 0), and take 10 ** x")
        return max(4, most)

    def expression(self, text):
        """R's words, in which `any name` may stand between backquotes."""
        if not isinstance(text, str):
            raise SpaceError(f"a condition must be a text, such as 'x > 0.5', found {text!r}")

        def written(found):
            if found[1] not in self.written:
                raise SpaceError(f"`{found[1]}` in {text!r} is not a parameter{self._nearest(found[1])}")
            return self.written[found[1]]
        return re.sub(r"`([^`]*)`", written, text)

    def parameter_lines(self):
        for name, domain in self.domains.items():
            written = self.written[name]
            condition = f" | {self.expression(domain.when)}" if domain.when else ""
            yield f'{written} "{written}=" {domain.letter} ({self.expression(domain.domain())}){condition}'

    def configuration_line(self, configuration):
        if not isinstance(configuration, dict):
            raise SpaceError(f"a configuration must be a dictionary of names and values, found {configuration!r}")
        for name in configuration:
            if name not in self.domains:
                raise SpaceError(f"'{name}' is not a parameter of the space{self._nearest(name)}")
        cells = []
        for name, domain in self.domains.items():
            try:
                cells.append(domain.text(configuration[name]) if name in configuration else "NA")
            except SpaceError as error:
                raise SpaceError(f"{name}: {error}") from None
        return " ".join(cells)

    def _nearest(self, name):
        near = difflib.get_close_matches(str(name), self.domains, 1)
        return f"; did you mean '{near[0]}'?" if near else ": it has " + ", ".join(self.domains)

    def values(self, texts):
        """A configuration of irace's names and values, the inactive ones None or absent."""
        return {self.names[written]: self.domains[self.names[written]].value(text)
                for written, text in texts.items() if text is not None}
