// Numbers, times and words as people read them.

const kThin = "\u2009";
const kMinus = "\u2212";

/// 12345.6 -> "12 346" with a thin space.
export function whole(value: number | null | undefined): string {
  if (value === null || value === undefined || !isFinite(value)) return "–";
  const digits = Math.abs(Math.round(value)).toString();
  return (value < -0.5 ? kMinus : "") + digits.replace(/\B(?=(\d{3})+$)/g, kThin);
}

/// A measured number in four digits: 2.761, 381 000, 0.0123.
export function number(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !isFinite(value)) return "–";
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
  if (seconds === null || seconds === undefined || !isFinite(seconds) || seconds < 0) return "–";
  const s = Math.round(seconds);
  if (s < 60) return `${seconds < 10 ? Number(seconds.toPrecision(seconds < 0.01 ? 1 : 2)) : s}${kThin}s`;
  if (s < 3600) return `${Math.floor(s / 60)}${kThin}min ${s % 60}${kThin}s`;
  if (s < 86400) return `${Math.floor(s / 3600)}${kThin}h ${Math.floor(s / 60) % 60}${kThin}min`;
  return `${Math.floor(s / 86400)}${kThin}d ${Math.floor(s / 3600) % 24}${kThin}h`;
}

/// The time of day where the reader is.
export function clock(time: Date): string {
  return time.toLocaleTimeString("en-GB");
}

/// A UTC text of a store ("2026-11-25 12:03:04" or with T and Z) as a date; null: none.
export function utc(text: string | null | undefined): Date | null {
  if (!text) return null;
  const date = new Date(text.replace(" ", "T").replace(/Z?$/, "Z"));
  return isNaN(date.getTime()) ? null : date;
}

/// Day and time where the reader is; the time alone when it was today.
export function when(text: string | null | undefined): string {
  const date = utc(text);
  if (!date) return text ?? "–";
  const today = date.toDateString() === new Date().toDateString();
  return (today ? "" : date.toLocaleDateString("en-CA") + " ") + clock(date);
}

/// "1 worker", "2 workers".
export function count(value: number, one: string, many = one + "s"): string {
  return `${whole(value)} ${value === 1 ? one : many}`;
}

/// "grid_exploration" as a name that people read.
export function words(name: string): string {
  return name.replace(/_/g, " ");
}

/// "c812" from a column's 812, or from what is a text already; null: none.
export function id_of(letter: string, value: string | number | null | undefined): string | null {
  return value === null || value === undefined ? null : typeof value === "number" ? letter + value : value;
}

/// A word of a shell's command line, quoted if it must be.
export function shell_word(text: string): string {
  return /^[\w@%+=:,./-]+$/.test(text) ? text : "'" + text.replace(/'/g, "'\\''") + "'";
}

/// RFC 4180.
export function csv(rows: unknown[][]): string {
  const cell = (value: unknown) => {
    const text = value === null || value === undefined ? "" : String(value);
    return /[",\r\n]/.test(text) ? '"' + text.replace(/"/g, '""') + '"' : text;
  };
  return rows.map((row) => row.map(cell).join(",") + "\r\n").join("");
}

/// The rows of a CSV text.
export function parse_csv(text: string): string[][] {
  const rows: string[][] = [[]];
  const cell = /(?:"((?:[^"]|"")*)"|([^",\r\n]*))(,|\r?\n|$)/g;
  for (let found; cell.lastIndex < text.length && (found = cell.exec(text));) {
    rows[rows.length - 1].push(found[1] !== undefined ? found[1].replace(/""/g, '"') : found[2]);
    if (found[3] !== "," && cell.lastIndex < text.length) rows.push([]);
  }
  return rows;
}
