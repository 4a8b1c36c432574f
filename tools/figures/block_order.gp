# How the index orders faces: Hough points near the plane z = 0, by the number of their block.
wide = 1400; high = 1180
load style
set size ratio -1
unset border; unset tics; unset grid; unset key
set lmargin 1; set rmargin 14; set tmargin 1; set bmargin 1
set palette defined (0 "#3b2a78", 1 "#2667b5", 2 "#2aa5a0", 3 "#74b84a", 4 "#e8c13a", 5 "#d9672b", 6 "#a8234c")
set cbrange [0:blocks]
set cbtics scale 0 ("first block" 0, "last block" blocks) textcolor rgb ink
set colorbox user origin 0.85, 0.3 size 0.018, 0.4 noborder
plot "layout_points.dat" using 1:2:3 with points pt 7 ps 0.55 lc palette
