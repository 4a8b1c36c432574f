# Figure 3.1: where the points lie.
wide = 1600; high = 1500
load style
set multiplot layout 2, 2 margins 0.085, 0.985, 0.075, 0.96 spacing 0.1, 0.11
unset key

set size ratio -1
set grid xtics ytics linecolor rgb pale linewidth 0.8
set format y "%g"
near = dual_99
set xrange [-near:near]; set yrange [-near:near]
set title "Dual space: the nearest 99 of 100 points"
plot "dual.dat" using 1:2 with points pt 7 ps 0.22 lc rgb "#70cc4637"
set xrange [-1:1]; set yrange [-1:1]
set title "Hough space: all points"
plot "hough.dat" using 1:2 with points pt 7 ps 0.22 lc rgb "#702667b5"

set size noratio
unset grid
set grid ytics linecolor rgb pale linewidth 0.8
set style fill solid 0.85 noborder
set boxwidth 0.92 relative
set logscale y
set yrange [0.7:*]
set format y "10^{%T}"
set format x "%g"
set ylabel "points" offset 0.5, 0
set xlabel "distance from the origin"
set xtics 10000
set xrange [0:dual_far]
set title "Dual space: one bar holds nearly all points"
plot "dual_distances.dat" using 1:($2 > 0 ? $2 : 0.1) with boxes lc rgb red
unset logscale y
set yrange [0:*]
set format y "%.0f"
set xlabel "distance from the origin"
set xtics 0.2
unset ylabel
set xrange [0:1]
set title "Hough space"
plot "hough_distances.dat" using 1:2 with boxes lc rgb blue
unset multiplot
