#pragma once

#include <string_view>

namespace swarmsmith {

/// The report's style sheet. Figures keep a white background in dark mode, because their colours
/// are made for paper. Content that is wider than a phone scrolls in its own box instead of being
/// scaled down until it is unreadable; on paper it fits the page.
inline constexpr std::string_view kReportStyle = R"(
:root { color-scheme: light dark; --ink: #1c1c1c; --paper: #ffffff; --line: #c4c4c4; --soft: #f2f3f5;
  --faint: #595959; --link: #0b5394; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e8e8e8; --paper: #17191d; --line: #4a4e57; --soft: #23262c; --faint: #b4b4b4;
    --link: #8ab8ff; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 70rem; padding: 1rem; color: var(--ink); background: var(--paper);
  font: 1rem/1.5 Helvetica, Arial, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: .5rem 0; }
h2 { font-size: 1.35rem; line-height: 1.25; margin: 2.5rem 0 .5rem; padding-top: .5rem;
  border-top: 2px solid var(--line); }
h3 { font-size: 1.1rem; margin: 1.8rem 0 .4rem; }
p { max-width: 45rem; margin: .5rem 0; }
a { color: var(--link); }
nav ul { list-style: none; margin: 0; padding: 0; columns: 3 16rem; }
nav li { margin: .15rem 0; break-inside: avoid; }
nav li.inner { padding-left: 1rem; font-size: .9rem; }
.wide { overflow-x: auto; margin: 0 0 .8rem; max-width: 100%; }
.wide:focus-visible { outline: 2px solid var(--link); }
table { border-collapse: collapse; width: max-content; font-size: .875rem;
  font-variant-numeric: tabular-nums; }
table.facts { width: auto; }
p.caption { color: var(--faint); font-size: .875rem; margin: 1rem 0 .2rem; }
th, td { padding: .2rem .6rem; text-align: left; vertical-align: top;
  border-bottom: 1px solid var(--line); max-width: 22rem; overflow-wrap: break-word; }
thead th { background: var(--soft); vertical-align: bottom; max-width: 9rem;
  overflow-wrap: normal; }
tbody th { font-weight: 600; white-space: nowrap; }
th.n, td.n { text-align: right; }
td.n, tbody th.n { white-space: nowrap; }
table.facts td { max-width: 45rem; overflow-wrap: anywhere; min-width: 8rem; }
figure { margin: 1rem 0; break-inside: avoid; }
figure .wide { display: inline-block; margin: 0; background: #ffffff; border: 1px solid var(--line);
  border-radius: 4px; }
figure svg { display: block; }
figcaption { color: var(--faint); font-size: .875rem; max-width: 45rem; }
.grid { display: grid; gap: 0 1rem;
  grid-template-columns: repeat(auto-fill, minmax(min(21rem, 100%), 1fr)); }
.grid figure { margin: .5rem 0; min-width: 0; }
.grid figure .wide { display: block; width: fit-content; }
ul.links { columns: 3 16rem; }
summary { cursor: pointer; }
summary h2 { display: inline-block; border: 0; margin: 1rem 0 .3rem; padding: 0; }
details { border-top: 2px solid var(--line); margin-top: 1rem; }
details.small { border: 0; margin: .5rem 0; }
details pre, details p, details table { font-size: .875rem; }
pre { background: var(--soft); padding: .6rem; margin: .5rem 0; font-size: .8rem; line-height: 1.4;
  white-space: pre-wrap; overflow-wrap: anywhere; border-radius: 4px; }
@page { margin: 15mm; }
@media print {
  :root { color-scheme: light; --ink: #000000; --paper: #ffffff; --line: #999999; --soft: #f2f2f2;
    --faint: #333333; --link: #000000; }
  body { max-width: none; padding: 0; font-size: 10pt; }
  nav { display: none; }
  .chapter { break-before: page; }
  h2, h3, p.caption { break-after: avoid; }
  tr, pre { break-inside: avoid; }
  thead { display: table-header-group; }
  .grid { grid-template-columns: 1fr 1fr; }
  .wide { overflow: visible; }
  figure .wide { border: 0; }
  figure svg { max-width: 100%; height: auto; }
  table { font-size: 8pt; }
  th, td { padding: .1rem .3rem; }
}
)";

}  // namespace swarmsmith
