# Border points missed and extra over the amount of noise, outliers and uneven sampling: a curve for each of `titles`, set
# by tools/figures/plot_points.py.
wide = 1900; high = 1150
load style
set multiplot layout 2,3 margins 0.065,0.99,0.16,0.94 spacing 0.06,0.13
array colors[4] = [green, blue, amber, gray]
set key off
set yrange [0:*]
set xtics format "%g"
set format y "%g%%"
do for [row=1:2] {
    do for [kind in "noise outliers uneven"] {
        set title (row == 1 ? "missed, " : "extra, ") . kind
        set xrange [0:kind eq "noise" ? 0.2 : kind eq "outliers" ? 0.05 : 0.75]
        if (row == 2 && kind eq "outliers") {
            set key at screen 0.5, 0.055 center maxrows 1 width 1
        } else {
            set key off
        }
        plot for [i=1:words(titles)] kind . i . ".dat" using 1:row + 1 with linespoints lc rgb colors[i] pt 7 ps 1.1 \
            title word(titles, i)
    }
}
unset multiplot
