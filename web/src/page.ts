import { Live } from "./types";

export interface PageProps {
  /// Of the page's pattern: c "c1", d "d3", ...
  params: Record<string, string>;
  query: Record<string, string>;
  live: Live;
}

/// Where somebody is: navigation leads to the pages of this campaign and design.
export interface Place { c: string; d: string | null }

export interface Key { key: string; what: string }

export interface Page {
  /// Its address: match() in route.ts.
  pattern: string;
  title: (params: Record<string, string>) => string;
  view: new (props?: PageProps, context?: any) => any;
  /// An entry of the navigation; g and the letter go there.
  nav?: { label: string; letter: string; path: (place: Place) => string[] | null };
  /// Keys of its own, for the help.
  keys?: Key[];
}
