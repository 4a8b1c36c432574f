# What a static query does: where the walk from the root ends.
wide = 1600; high = 1260
load style
set size ratio -1
unset border; unset tics; unset grid
set xrange [-0.95:1.5]; set yrange [-0.95:0.98]
set lmargin 1; set rmargin 1; set tmargin 1; set bmargin 1
set key at screen 0.5, screen 0.03 center bottom horizontal Left reverse samplen 1.6 width 2 maxrows 1
set style fill transparent solid 0.25 border
set object 1 circle at pole_x / 2, pole_y / 2 size sqrt(pole_x**2 + pole_y**2) / 2 front fs empty border lc rgb ink lw 2.2
set style textbox opaque fillcolor rgb "#ffffff" noborder margins 0.6, 0.4
set label 1 "origin" at -0.05, -0.13 right textcolor rgb ink front boxed
set label 2 "viewpoint" at pole_x + 0.035, pole_y + 0.01 left textcolor rgb ink front
plot "boxes_outside.dat" using 1:2:3:4:5:6 with boxxyerror lc rgb gray fs transparent solid 0.16 border lc rgb gray title "settled: outside", \
     "boxes_inside.dat" using 1:2:3:4:5:6 with boxxyerror lc rgb blue fs transparent solid 0.16 border lc rgb blue title "settled: inside", \
     "boxes_looked_at.dat" using 1:2:3:4:5:6 with boxxyerror lc rgb red fs transparent solid 0.5 border lc rgb red title "blocks looked at", \
     "layout_points.dat" using 1:2 with points pt 7 ps 0.16 lc rgb "#902b2f36" notitle, \
     "poles.dat" using 1:2 with points pt 7 ps 1.3 lc rgb ink notitle
