# Figure 3.8: work against the size of the silhouette.
wide = 1600; high = 860
load style
set multiplot layout 1, 2 margins 0.075, 0.975, 0.135, 0.93 spacing 0.085, 0
set key top left
set xrange [0:*]; set yrange [0:*]
set format y "%.0s%c"
set format x "%.0s%c"
set xlabel "edges on the silhouette"
set title "Igea, as the thesis plots it"
plot igea using 2:1 with linespoints lc rgb red pt 7 ps 1.1 title "faces of the model", \
     igea using 2:3 with linespoints lc rgb blue pt 7 ps 1.1 title "box checks"
set title "Box checks of four models"
plot igea using 2:3 with linespoints lc rgb blue pt 7 ps 1.1 title "Igea", \
     bunny using 2:3 with linespoints lc rgb green pt 5 ps 1.1 title "Bunny", \
     horse using 2:3 with linespoints lc rgb amber pt 9 ps 1.3 title "Horse", \
     nefertiti using 2:3 with linespoints lc rgb ink pt 13 ps 1.4 title "Nefertiti"
unset multiplot
