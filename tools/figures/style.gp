# What all figures share. `out` is set by plot_figures.py; `wide` and `high` by the figure, in pixels of
# a page that is shown at half that size.
is_svg = strstrt(out, ".svg") > 0
if (is_svg) set terminal svg size wide / 2, high / 2 font "DejaVu Sans,10" linewidth 0.9 rounded background "#ffffff"
if (!is_svg) set terminal pngcairo size wide, high font "DejaVu Sans,20" linewidth 1.6 rounded background "#ffffff"
set output out
ink = "#2b2f36"
gray = "#9aa1ab"
pale = "#e3e6ea"
green = "#2f8f5b"
blue = "#2667b5"
red = "#cc4637"
amber = "#d9952b"
set border 3 linecolor rgb gray linewidth 0.8
set tics nomirror out scale 0.5 textcolor rgb ink
set grid ytics linecolor rgb pale linewidth 0.8 dashtype solid
set title textcolor rgb ink offset 0, -0.4
set xlabel textcolor rgb ink
set ylabel textcolor rgb ink
set key textcolor rgb ink nobox samplen 1.5 Left reverse
set format y "%.0f"
