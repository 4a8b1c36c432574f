# Figure 3.11: leaves by depth, one panel a model.
wide = 1600; high = 900
load style
set multiplot layout 2, 3 margins 0.055, 0.985, 0.12, 0.945 spacing 0.055, 0.15
set style fill solid 0.8 noborder
set boxwidth 1.0
set xrange [0:45]
set yrange [0:30]
set ytics 10
set format y "%.0f%%"
set xtics 10
do for [i = 1:words(models)] {
    set title word(titles, i)
    if (i == 1) { set key top right } else { unset key }
    if (i > 3) { set xlabel "depth" textcolor rgb ink offset 0, 0.3 } else { unset xlabel }
    file = word(models, i)."_depths.dat"
    plot file using 1:2 with boxes lc rgb "#302667b5" title "Hough", \
         file using 1:3 with boxes lc rgb "#30cc4637" title "dual"
}
unset multiplot
