# Figures 3.9 and 3.10: work around the circle, one panel a model. `first` is the first curve's column.
wide = 1600; high = rows * 400 + 110
load style
set multiplot
left(i) = 0.055 + 0.323 * ((i - 1) % 3)
bottom(i) = 1 - (110 + 400.0 * ((i - 1) / 3 + 1) - 65) / high
set xrange [0:360]
set xtics 90 format "%.0f°"
set logscale y
set ytics (20, 50, 100, 200, 500, "1k" 1000, "2k" 2000, "5k" 5000, "10k" 10000, "20k" 20000, "50k" 50000)
set autoscale yfix
unset key

# One legend for all panels.
names = "dual Hough Hough, walk as written Hough, complete walk index"
array colors[5] = [red, green, blue, amber, ink]
array places[5] = [0.055, 0.16, 0.28, 0.555, 0.81]
do for [k = 1:5] {
    set arrow k from screen places[k], screen 1 - 38.0 / high to screen places[k] + 0.025, screen 1 - 38.0 / high nohead lc rgb colors[k] lw 2.5
    set label k word(names, k) at screen places[k] + 0.033, screen 1 - 38.0 / high left textcolor rgb ink
}
do for [i = 1:words(models)] {
    set lmargin at screen left(i)
    set rmargin at screen left(i) + 0.275
    set bmargin at screen bottom(i)
    set tmargin at screen bottom(i) + 285.0 / high
    set title word(titles, i)
    file = word(models, i)."_orbit.dat"
    plot for [k = 1:5] file using 1:(column(first + k - 1)) with lines lc rgb colors[k] lw 1.4
    unset arrow
    unset label
}
unset multiplot
