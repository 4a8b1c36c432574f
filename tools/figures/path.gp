# Figures 4.16 and 4.17: a camera path around a model, and what the first field says along it.
wide = 1800; high = 860
load style
set multiplot
set lmargin at screen 0.01
set rmargin at screen 0.47
set bmargin at screen 0.02
set tmargin at screen 0.98
unset border
unset tics
unset key
set size ratio -1
set xrange [-2.15:2.15]
set yrange [-2.15:2.15]
set object 1 circle at 0,0 size sqrt(3) fillstyle empty border lc rgb pale lw 1.2
set object 2 circle at 0,0 size 2 fillstyle empty border lc rgb pale lw 1.2
plot 'path.dat' using 1:($3 < 0 ? $2 : 1/0) with lines lw 1.2 dt 3 lc rgb amber, \
     'model.dat' with lines lw 0.8 lc rgb ink, \
     'path.dat' using 1:($3 >= 0 ? $2 : 1/0) with lines lw 2.4 lc rgb amber, \
     'nodes.dat' using 1:($5 == 0 ? $2 : 1/0) with points pt 7 ps 1.6 lc rgb green, \
     'nodes.dat' using 1:($5 > 0 ? $2 : 1/0) with points pt 7 ps 2.2 lc rgb blue, \
     'nodes.dat' using ($1 + 0.13):($5 > 0 ? $2 + 0.08 : 1/0):(sprintf("%d", $5)) with labels tc rgb blue
unset object 1
unset object 2
set size noratio
set border 3
set lmargin at screen 0.56
set rmargin at screen 0.985
set bmargin at screen 0.13
set tmargin at screen 0.95
set tics nomirror out scale 0.5
set xrange [0:1]
set yrange [0:1.05]
set format x "%.0f%%"
set format y "%.1f"
set xtics ("0" 0, "1/4" 0.25, "1/2" 0.5, "3/4" 0.75, "1" 1)
set ytics 0.2
set xlabel "share of the way"
set ylabel "votes of the first field, of the greatest"
plot 'votes.dat' with lines lw 2.4 lc rgb amber, \
     'nodes.dat' using 3:($5 == 0 ? $4 : 1/0) with points pt 7 ps 1.6 lc rgb green, \
     'nodes.dat' using 3:($5 > 0 ? $4 : 1/0) with points pt 7 ps 2.2 lc rgb blue, \
     'nodes.dat' using 3:($5 > 0 ? $4 - 0.07 : 1/0):(sprintf("%d", $5)) with labels tc rgb blue
unset multiplot
