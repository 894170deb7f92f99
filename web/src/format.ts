// Formats numbers, times and words for people.

const kThin = "\u2009";
const kMinus = "\u2212";

/// Whether there is a value.
export function is_known<T>(value: T | null | undefined): value is T {
  return value !== null && value !== undefined;
}

/// The value, limited to the range.
export function clamp(value: number, low: number, high: number): number {
  return Math.max(low, Math.min(high, value));
}

/// 12345.6 -> "12 346" with a thin space.
export function whole(value: number | null | undefined): string {
  if (!is_known(value) || !isFinite(value)) return "–";
  const digits = Math.abs(Math.round(value)).toString();
  return (value < -0.5 ? kMinus : "") + digits.replace(/\B(?=(\d{3})+$)/g, kThin);
}

/// A measured number with four digits: 2.761, 381 000, 0.0123.
export function number(value: number | null | undefined, digits = 4): string {
  if (!is_known(value) || !isFinite(value)) return "–";
  const size = Math.abs(value);
  if (Number.isSafeInteger(value) || size >= 10 ** (digits - 1) && size < 1e9) return whole(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e9)) return value.toExponential(digits - 2).replace("-", kMinus);
  return String(Number(value.toPrecision(digits))).replace("-", kMinus);
}

export function percent(part: number): string {
  return isFinite(part) ? `${Math.round(100 * part)}${kThin}%` : "–";
}

/// 3725 -> "1 h 2 min".
export function duration(seconds: number | null | undefined): string {
  if (!is_known(seconds) || !isFinite(seconds) || seconds < 0) return "–";
  const s = Math.round(seconds);
  if (s < 60) return `${seconds < 10 ? Number(seconds.toPrecision(seconds < 0.01 ? 1 : 2)) : s}${kThin}s`;
  const both = (large: string, small: string, size: number, parts: number) =>
    `${Math.floor(s / size / parts)}${kThin}${large} ${Math.floor(s / size) % parts}${kThin}${small}`;
  return s < 3600 ? both("min", "s", 1, 60) : s < 86400 ? both("h", "min", 60, 60) : both("d", "h", 3600, 24);
}

/// The time of day in the reader's time zone.
export function clock(time: Date): string {
  return time.toLocaleTimeString("en-GB");
}

/// A UTC time from a store ("2026-11-25 12:03:04" or with T and Z), in the reader's time zone;
/// without the date if it is today.
export function when(text: string): string {
  const date = new Date(text.replace(" ", "T").replace(/Z?$/, "Z"));
  if (isNaN(date.getTime())) return text;
  return (date.toDateString() === new Date().toDateString() ? "" : date.toLocaleDateString("en-CA") + " ") + clock(date);
}

/// "1 worker", "2 workers".
export function count(value: number, one: string, many = one + "s"): string {
  return `${whole(value)} ${value === 1 ? one : many}`;
}

/// "grid_exploration" in words.
export function words(name: string): string {
  return name.replace(/_/g, " ");
}

/// Without duplicates, in natural order: 3 before 20.
export function in_order(names: Iterable<string>): string[] {
  return [...new Set(names)].sort((a, b) => a.localeCompare(b, "en", { numeric: true }));
}

/// "c812" from the number 812 in a column; texts stay unchanged; null: no id.
export function id_of(letter: string, value: string | number | null | undefined): string | null {
  return !is_known(value) ? null : typeof value === "number" ? letter + value : value;
}

/// An argument for a shell's command line, quoted if necessary.
export function shell_word(text: string): string {
  return /^[\w@%+=:,./-]+$/.test(text) ? text : "'" + text.replace(/'/g, "'\\''") + "'";
}

/// Texts that a spreadsheet would evaluate as formulas, except numbers and switches (--s0 1).
const kFormula = /^'*([=+@\t\r\n]|-(?!-?[a-z][\w .\-/:,]*$))/i;

/// RFC 4180, with an apostrophe before texts that a spreadsheet would evaluate, as in the files of
/// the command line.
export function csv(rows: unknown[][]): string {
  const cell = (value: unknown) => {
    let text = String(value ?? "");
    if (kFormula.test(text) && isNaN(Number(text))) text = "'" + text;
    return /[",\r\n]/.test(text) ? '"' + text.replace(/"/g, '""') + '"' : text;
  };
  return rows.map((row) => row.map(cell).join(",") + "\r\n").join("");
}

/// The rows of a CSV text.
export function parse_csv(text: string): string[][] {
  const rows: string[][] = [[]];
  const cell = /(?:"((?:[^"]|"")*)"|([^",\r\n]*))(,|\r?\n|$)/g;
  for (let found; cell.lastIndex < text.length && (found = cell.exec(text));) {
    const field = found[1] !== undefined ? found[1].replace(/""/g, '"') : found[2];
    rows[rows.length - 1].push(field[0] === "'" && kFormula.test(field) ? field.slice(1) : field);
    if (found[3] !== "," && cell.lastIndex < text.length) rows.push([]);
  }
  return rows;
}
