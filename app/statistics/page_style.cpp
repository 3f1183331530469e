#include "app/statistics/page_style.h"

namespace dollytrack::statistics {

const char* const kPageStyle = R"css(
:root {
  --background: #f4f5f7; --panel: #ffffff; --text: #1c1e21; --quiet: #565b63; --line: #d9dce1;
  --grid: #e7e9ed; --c0: #0f4fd4; --c1: #a8301f; --c2: #00a28f; --c3: #d08400; --c4: #8040a8;
  --c5: #15151c;
}
@media (prefers-color-scheme: dark) {
  :root {
    --background: #151619; --panel: #1e2024; --text: #e6e7ea; --quiet: #a5abb5; --line: #383c43;
    --grid: #2b2e34; --c0: #3f9bff; --c1: #d2682c; --c2: #2f9e86; --c3: #ffe14d; --c4: #c3a0dd;
    --c5: #ffffff;
  }
}
.s0 { --c: var(--c0); } .s1 { --c: var(--c1); } .s2 { --c: var(--c2); }
.s3 { --c: var(--c3); } .s4 { --c: var(--c4); } .s5 { --c: var(--c5); }
* { box-sizing: border-box; }
body {
  margin: 0 auto; padding: 20px 16px 48px; max-width: 1280px; background: var(--background);
  color: var(--text); font: 14px/1.45 "Inter", "DejaVu Sans", system-ui, sans-serif;
}
h1 { font-size: 22px; margin: 0 0 4px; overflow-wrap: anywhere; }
h2 { font-size: 17px; margin: 32px 0 12px; }
h3 { font-size: 14px; margin: 0; }
p { margin: 0; }
.single table.classes td { min-width: 110px; }
.quiet, .note { color: var(--quiet); font-size: 13px; }
.key { overflow-wrap: anywhere; }
.key::before {
  content: ""; display: inline-block; width: 10px; height: 10px; margin-right: 6px;
  border-radius: 2px; background: var(--c);
}
#datasets {
  position: sticky; top: 0; z-index: 1; display: flex; flex-wrap: wrap; gap: 4px 20px;
  margin: 12px -16px 0; padding: 8px 16px; background: var(--background);
  border-bottom: 1px solid var(--line);
}
.charts {
  display: grid; grid-template-columns: repeat(auto-fill, minmax(min(340px, 100%), 1fr)); gap: 14px;
}
figure {
  margin: 0; padding: 12px 14px; border: 1px solid var(--line); border-radius: 8px;
  background: var(--panel);
}
figcaption { margin-bottom: 6px; }
figure svg { display: block; width: 100%; height: auto; }
svg text { font-size: 11px; fill: var(--quiet); }
svg .y { text-anchor: end; } svg .x { text-anchor: middle; } svg .value { fill: var(--text); }
svg .label { fill: var(--text); }
svg .grid { fill: none; stroke: var(--grid); } svg .base { fill: none; stroke: var(--quiet); }
svg .bars { fill: var(--c); } svg .area { fill: var(--c); fill-opacity: 0.13; }
svg .whole { fill: var(--c); fill-opacity: 0.13; stroke: var(--c); stroke-width: 0.8; }
svg .line { fill: none; stroke: var(--c); stroke-width: 1.6; stroke-linejoin: round; }
svg .median { fill: none; stroke: var(--c); stroke-width: 1.2; stroke-dasharray: 4 3; }
.single svg .median { stroke: var(--text); }
svg .bin { fill: var(--text); fill-opacity: 0; } svg .bin:hover { fill-opacity: 0.08; }
dl {
  display: grid; grid-template-columns: repeat(auto-fill, minmax(150px, 1fr)); gap: 10px; margin: 0;
}
dl div {
  display: flex; flex-direction: column-reverse; justify-content: flex-end;
  padding: 8px 12px; border: 1px solid var(--line); border-radius: 8px; background: var(--panel);
}
dd { margin: 0; font-size: 19px; font-weight: 600; font-variant-numeric: tabular-nums; }
dt { color: var(--quiet); font-size: 12.5px; line-height: 1.3; }
.table { max-width: 100%; width: fit-content; overflow-x: auto; border: 1px solid var(--line); border-radius: 8px; background: var(--panel); }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
.charts + .table { margin-top: 14px; }
th, td { padding: 4px 9px; text-align: right; white-space: nowrap; font-weight: 400; }
th:first-child { text-align: left; } thead th { font-weight: 600; }
tbody tr { border-top: 1px solid var(--grid); }
.compared .first { border-left: 1px solid var(--line); }
.compared thead th[colspan] { text-align: center; }
small { display: inline-block; min-width: 3.4em; color: var(--quiet); font-size: 12px; }
.note { margin-top: 6px; }
.frames {
  display: grid; grid-template-columns: repeat(auto-fill, minmax(min(270px, 100%), 1fr)); gap: 14px;
}
.frames figure { padding: 0; overflow: hidden; }
.frames figcaption { margin: 0; padding: 6px 10px; font-size: 13px; }
.frames rect { fill: #fff; fill-opacity: 0; stroke-width: 1.6; vector-effect: non-scaling-stroke; }
.frames rect:hover { fill-opacity: 0.25; }
@media (max-width: 600px) {
  th, td { padding: 4px 6px; }
  tbody th { min-width: 96px; white-space: normal; }
  .single table.classes td { min-width: 0; }
}
)css";

}  // namespace dollytrack::statistics
