// Addresses. A view is a fragment, "#/c1/d3/race/8?step=120". It works under any prefix and in a
// file, and it contains the complete state of the view, so that it can be sent to another person.

import { is_known } from "./format";

export interface Route {
  path: string[];
  query: Record<string, string>;
}

export type Query = Record<string, string | number | null | undefined>;

export function parse_route(fragment: string): Route {
  const [path, query] = fragment.replace(/^#?\/?/, "").split(/\?(.*)/s);
  return { path: path.split("/").filter(Boolean).map(decoded), query: Object.fromEntries(new URLSearchParams(query)) };
}

/// The parameters that have a value, as texts.
export function given(query: Query): [string, string][] {
  return Object.entries(query).filter(([, value]) => is_known(value) && value !== "").map(([name, value]) => [name, String(value)]);
}

/// The address of a view. Values that are null, undefined or empty are left out.
export function href(path: string[], query: Query = {}): string {
  // Commas and colons are allowed in a fragment, and easier to read than %2C.
  const text = new URLSearchParams(given(query)).toString().replace(/%2C/g, ",").replace(/%3A/g, ":");
  return "#/" + path.map(encodeURIComponent).join("/") + (text && "?" + text);
}

export function current_route(): Route {
  return parse_route(location.hash);
}

export function go(address: string): void {
  location.hash = address;
}

/// Changes parts of the current view's state. `remember` adds a step for the browser's back button.
export function set_query(changes: Query, remember = false): void {
  const { path, query } = current_route();
  const address = href(path, { ...query, ...changes });
  if (address === location.hash) return;
  if (remember) return go(address);
  history.replaceState(null, "", address);
  dispatchEvent(new HashChangeEvent("hashchange"));
}

const kShapes: Record<string, RegExp> = { c: /^c\d+$/, d: /^d\d+$/, candidate: /^c\d+$/ };

/// The values of a pattern such as ":c/:d/race/:iteration"; null if the path does not match it.
/// ":c" matches c1, ":d" d3, ":candidate" c812; a name with "?" at the end is optional.
export function match(pattern: string, path: string[]): Record<string, string> | null {
  const words = pattern.split("/");
  const values: Record<string, string> = {};
  const fits = words.every((word, i) => {
    const here = path[i];
    const [, name, may_miss] = /^:(\w+)(\??)$/.exec(word) ?? [];
    if (!name || !here) return here ? word === here : may_miss;
    values[name] = here;
    return kShapes[name]?.test(here) ?? true;
  });
  return fits && path.length <= words.length ? values : null;
}

/// The path of a pattern with values for its names, without the optional ones; null if a value is
/// missing.
export function filled(pattern: string, values: Record<string, string | undefined>): string[] | null {
  const path = pattern.split("/").filter((word) => !word.endsWith("?")).map((word) => word[0] === ":" ? values[word.slice(1)] : word);
  return path.every(is_known) ? path as string[] : null;
}

function decoded(word: string): string {
  try { return decodeURIComponent(word); } catch { return word; }
}
