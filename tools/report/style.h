#pragma once
// Style of a report on a screen and on paper.

namespace talus {

inline constexpr const char* report_style = R"(:root { color-scheme: light; }
body { margin: 0; background: #fff; color: #222; font: 16px/1.55 system-ui, "DejaVu Sans", sans-serif; }
main { max-width: 56rem; margin: 0 auto; padding: 2.5rem 1.5rem 4rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0; }
h2 { font-size: 1.25rem; margin: 2.5rem 0 0.6rem; padding-bottom: 0.3rem; border-bottom: 1px solid #ddd; }
.subtitle { margin: 0.4rem 0 0; color: #666; }
p { max-width: 42rem; }
.wide { overflow-x: auto; margin: 1.2rem 0; }
@media screen and (min-width: 64rem) {
  .wide { width: max-content; min-width: 100%; max-width: 94vw; position: relative; left: 50%;
          transform: translateX(-50%); }
}
table { border-collapse: collapse; font-size: 0.92rem; }
caption { caption-side: top; text-align: left; padding-bottom: 0.5rem; color: #666; }
th, td { padding: 0.35rem 0.65rem; text-align: left; vertical-align: baseline; }
th, th.number { border-bottom: 2px solid #666; font-weight: 600; max-width: 8rem; white-space: normal; vertical-align: bottom; }
td { border-bottom: 1px solid #e4e4e4; }
tbody tr:last-child td { border-bottom: 2px solid #666; }
.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
figure { margin: 1.5rem 0; }
figure svg { display: block; width: 100%; height: auto; }
figcaption { margin-top: 0.4rem; color: #666; font-size: 0.92rem; }
figure.page { width: 94vw; position: relative; left: 50%; transform: translateX(-50%); }
iframe { width: 100%; height: 88vh; min-height: 34rem; border: 1px solid #ccc; }
summary { cursor: pointer; }
pre { font-size: 0.85rem; line-height: 1.4; overflow-x: auto; background: #f7f7f8; padding: 0.8rem; }
@media print {
  .page { display: none; }
  body { font-size: 10.5pt; }
  main { max-width: none; padding: 0; }
  figure, tr { break-inside: avoid; }
  h2 { break-after: avoid; }
  .wide { overflow: visible; }
}
)";

}  // namespace talus
