# gnuplot time_error.gp: time_error.svg from time_error.csv.
set terminal svg size 1100,520 font "sans,12" background "#ffffff"
set output "time_error.svg"
set datafile separator ","
set multiplot layout 1,2 margins 0.06,0.98,0.36,0.93 spacing 0.07
set logscale x
set xlabel "time over that of full with the engine's own solver"
set ylabel "height of the centre of mass [m]"
set grid lc rgb "#dddddd"
set xrange [0.1:8]
set key at screen 0.5,0.01 bottom center maxrows 5 samplen 1
rows(d, run) = sprintf("<grep '^%d,%s,' time_error.csv", d, run)
band(d, low, high) = sprintf("set object %d rectangle from graph 0, first %g to graph 1, first %g fc rgb '#eeeeee' fs solid noborder behind", d, low, high)

set title "Example 1 in 2D"
set yrange [4.2:6.6]
eval band(2, 5.58, 5.68)
set key at screen 0.27,0.02
plot rows(2, "Box2D full") using 4:5:6 with yerrorbars pt 7 lc rgb "#1b6ca8" title "Box2D, small steps, full", \
     rows(2, "Box2D adaptive") using 4:5:6 with yerrorbars pt 6 lc rgb "#1b6ca8" title "adaptive", \
     rows(2, "Box2D own full") using 4:5:6 with yerrorbars pt 5 lc rgb "#7f8c8d" title "Box2D's own solver, full", \
     rows(2, "Box2D own adaptive") using 4:5:6 with yerrorbars pt 4 lc rgb "#7f8c8d" title "adaptive", \
     rows(2, "planar Bullet full") using 4:5:6 with yerrorbars pt 9 lc rgb "#2e8b57" title "planar Bullet, small steps, full", \
     rows(2, "planar Bullet adaptive") using 4:5:6 with yerrorbars pt 8 lc rgb "#2e8b57" title "adaptive", \
     rows(2, "planar Bullet own full") using 4:5:6 with yerrorbars pt 11 lc rgb "#b08030" title "Bullet's own solver, full", \
     rows(2, "planar Bullet own adaptive") using 4:5:6 with yerrorbars pt 10 lc rgb "#b08030" title "adaptive", \
     rows(2, "Box2D v3") using 4:5:6 with yerrorbars pt 13 ps 1.3 lc rgb "#c0392b" title "Box2D v3"

set title "Example 1 in 3D"
set yrange [1.1:1.45]
unset object 2
eval band(3, 1.291, 1.311)
set key at screen 0.78,0.02
plot rows(3, "Bullet full") using 4:5:6 with yerrorbars pt 9 lc rgb "#2e8b57" title "Bullet, small steps, full", \
     rows(3, "Bullet adaptive") using 4:5:6 with yerrorbars pt 8 lc rgb "#2e8b57" title "adaptive", \
     rows(3, "Bullet own full") using 4:5:6 with yerrorbars pt 11 lc rgb "#b08030" title "Bullet's own solver, full", \
     rows(3, "Bullet own adaptive") using 4:5:6 with yerrorbars pt 10 lc rgb "#b08030" title "adaptive", \
     rows(3, "Jolt") using 4:5:6 with yerrorbars pt 13 ps 1.3 lc rgb "#c0392b" title "Jolt", \
     rows(3, "Box3D") using 4:5:6 with yerrorbars pt 12 ps 1.3 lc rgb "#8e44ad" title "Box3D"
