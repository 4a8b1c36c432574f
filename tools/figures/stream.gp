# Bytes streamed a frame over the step: a curve for each of `models`, set by tools/figures/plot_stream.py.
wide = 1600; high = 860
load style
set logscale xy
set xrange [0.01:20]; set yrange [0.1:150]
set format y "%g%%"
set xlabel "step, degrees"
set title "Bytes streamed a frame, of the whole state"
set key bottom right
array colors[3] = [green, amber, blue]
plot for [i=1:words(models)] word(models, i) . ".dat" using 1:2 with linespoints \
    lc rgb colors[i] pt 7 ps 1.1 title word(titles, i), 100 with lines lc rgb gray notitle
