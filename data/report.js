(function () {
  'use strict';
  // Paper shows all: a browser that prints has no way to open what is folded.
  addEventListener('beforeprint', () => document.querySelectorAll('details').forEach(d => { d.open = true; }));
  const read = id => JSON.parse(document.getElementById(id).textContent);
  const colours = ['#0a6b4f', '#c25a00', '#2b5fb8', '#8a3ffc', '#b3261e', '#5b6b7b'];
  const lineColours = ['#0a6b4f', '#b3261e'];
  Chart.defaults.animation = false;
  Chart.defaults.maintainAspectRatio = false;
  const canvas = place => {
    const div = document.createElement('div');
    const c = document.createElement('canvas');
    div.appendChild(c);
    document.getElementById(place).appendChild(div);
    return c;
  };
  const axis = (text, extra) => Object.assign({title: {display: true, text: text}}, extra);
  const flat = (errors, value, name, colour, dash) => ({
    label: name, type: 'line', data: errors.map(() => value), borderColor: colour, backgroundColor: colour,
    borderDash: dash, pointRadius: 0, pointStyle: 'line'
  });
  const bars = (errors, row) => new Chart(canvas('error-plots'), {
    type: 'bar',
    data: {
      labels: errors.map(e => e.name),
      datasets: [
        {label: 'this run', data: errors.map(e => e[row.key]), backgroundColor: '#0a6b4f', maxBarThickness: 60},
        flat(errors, row.mean, 'published mean', '#c25a00', [6, 4]),
        flat(errors, row.mean + row.sd, 'published mean + SD', '#e2b98f', [2, 4])]
    },
    options: {plugins: {title: {display: true, text: row.name + ' of each screw'}, legend: {labels: {usePointStyle: true}}},
              scales: {y: axis(row.unit, {beginAtZero: true})}}
  });
  const errors = read('error-data');
  if (errors.screws.length) errors.rows.forEach(row => bars(errors.screws, row));

  // What lies above the axis runs along its edge, dotted, between triangles where it leaves and returns.
  const above = p => p && p.was !== undefined;
  const isEdge = c => {
    const points = c.dataset.data, i = c.dataIndex;
    return above(points[i]) && !(above(points[i - 1]) && above(points[i + 1]));
  };
  const curve = (c, i) => ({
    label: c.name, data: c.points, showLine: true, borderWidth: 1.4, pointStyle: 'triangle',
    pointRadius: context => isEdge(context) ? 5 : 0, clip: 8,
    segment: {borderDash: s => above(s.p0.raw) && above(s.p1.raw) ? [1, 4] : undefined},
    borderColor: colours[i % colours.length], backgroundColor: colours[i % colours.length]
  });
  for (const plot of read('plot-data')) {
    const sets = plot.curves.map(curve);
    const xs = plot.curves.flatMap(c => c.points.map(p => p.x));
    const from = xs.reduce((a, b) => Math.min(a, b), Infinity), to = xs.reduce((a, b) => Math.max(a, b), -Infinity);
    if (xs.length) {
      plot.lines.forEach((line, i) => sets.push({
        label: line.name, showLine: true, pointRadius: 0, borderDash: [6, 4], borderWidth: 1.2,
        borderColor: lineColours[i % lineColours.length], data: [{x: from, y: line.y}, {x: to, y: line.y}]
      }));
    }
    const real = c => c.dataset.label + ': ' + (above(c.raw) ? c.raw.was : c.raw.y).toFixed(1);
    new Chart(canvas(plot.place), {
      type: 'scatter', data: {datasets: sets},
      options: {
        plugins: {title: {display: true, text: plot.title},
                  tooltip: {callbacks: {label: real}}},
        scales: {x: axis(plot.x, {min: xs.length ? from : 0, max: xs.length ? to : 1}),
                 y: axis(plot.y, plot.y_max > 0 ? {min: 0, max: plot.y_max} : {beginAtZero: true})}
      }
    });
  }
})();
