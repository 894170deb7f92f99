// Addresses. A view is a fragment, "#/c1/d3/race/8?step=120": it works under any prefix and from a
// file, and it holds all state of the view, so that it can be sent to somebody.

export interface Route {
  path: string[];
  query: Record<string, string>;
}

export type Query = Record<string, string | number | null | undefined>;

export function parse_route(fragment: string): Route {
  const [path, query] = fragment.replace(/^#?\/?/, "").split(/\?(.*)/s);
  const values: Record<string, string> = {};
  new URLSearchParams(query ?? "").forEach((value, name) => { values[name] = value; });
  return { path: path.split("/").filter((word) => word !== "").map(decoded), query: values };
}

/// The address of a view. Values that are null, undefined or empty are left out.
export function href(path: string[], query: Query = {}): string {
  const parameters = new URLSearchParams();
  for (const [name, value] of Object.entries(query))
    if (value !== null && value !== undefined && value !== "") parameters.set(name, String(value));
  // Commas and colons may stand in a fragment, and are easier to read than %2C.
  const text = parameters.toString().replace(/%2C/g, ",").replace(/%3A/g, ":");
  return "#/" + path.map(encodeURIComponent).join("/") + (text === "" ? "" : "?" + text);
}

export function current_route(): Route {
  return parse_route(location.hash);
}

export function go(address: string): void {
  location.hash = address;
}

/// Changes parts of the current view's state. `remember` makes a step for the browser's back button.
export function set_query(changes: Query, remember = false): void {
  const { path, query } = current_route();
  const address = href(path, { ...query, ...changes });
  if (address === location.hash) return;
  if (remember) { location.hash = address; return; }
  history.replaceState(null, "", address);
  dispatchEvent(new HashChangeEvent("hashchange"));
}

/// The values of a pattern such as ":c/:d/race/:iteration", null where it does not fit. ":c" takes
/// c1, ":d" d3, ":candidate" c812; "?" at the end of a name: may be missing.
export function match(pattern: string, path: string[]): Record<string, string> | null {
  const words = pattern.split("/").filter((word) => word !== "");
  if (path.length > words.length) return null;
  const values: Record<string, string> = {};
  for (let i = 0; i < words.length; ++i) {
    const optional = words[i].endsWith("?");
    const word = optional ? words[i].slice(0, -1) : words[i];
    if (i >= path.length) { if (optional) continue; return null; }
    if (!word.startsWith(":")) { if (word !== path[i]) return null; continue; }
    const name = word.slice(1);
    const shape = name === "c" || name === "candidate" ? /^c\d+$/ : name === "d" ? /^d\d+$/ : null;
    if (shape && !shape.test(path[i])) return null;
    values[name] = path[i];
  }
  return values;
}

function decoded(word: string): string {
  try { return decodeURIComponent(word); } catch { return word; }
}
