(function () {
  'use strict';
  const read = id => JSON.parse(document.getElementById(id).textContent);
  const colours = ['#0a6b4f', '#c25a00', '#2b5fb8', '#8a3ffc', '#b3261e', '#5b6b7b'];
  const box = document.querySelector('.plots');
  Chart.defaults.animation = false;
  Chart.defaults.maintainAspectRatio = false;
  const canvas = () => {
    const div = document.createElement('div');
    const c = document.createElement('canvas');
    div.appendChild(c);
    box.appendChild(div);
    return c;
  };
  const axis = (text, extra) => Object.assign({title: {display: true, text: text}}, extra);
  const flat = (errors, value, name, colour, dash) => ({
    label: name, type: 'line', data: errors.map(() => value), borderColor: colour,
    borderDash: dash, pointRadius: 0
  });
  const bars = (errors, row) => new Chart(canvas(), {
    type: 'bar',
    data: {
      labels: errors.map(e => e.name),
      datasets: [
        {label: 'this run', data: errors.map(e => e[row.key]), backgroundColor: '#0a6b4f'},
        flat(errors, row.mean, 'published mean', '#c25a00', [6, 4]),
        flat(errors, row.mean + row.sd, 'published mean + SD', '#e2b98f', [2, 4])]
    },
    options: {plugins: {title: {display: true, text: row.name + ' of each screw'}},
              scales: {y: axis(row.unit, {beginAtZero: true})}}
  });
  const errors = read('error-data');
  if (errors.screws.length) errors.rows.forEach(row => bars(errors.screws, row));
  for (const plot of read('plot-data')) {
    const sets = plot.curves.map((c, i) => ({
      label: c.name, data: c.points, showLine: true, pointRadius: 0, borderWidth: 1.2,
      borderColor: colours[i % colours.length], backgroundColor: colours[i % colours.length]
    }));
    const xs = plot.curves.flatMap(c => c.points.map(p => p.x));
    if (plot.limit > 0 && xs.length) {
      sets.push({label: 'limit', showLine: true, pointRadius: 0, borderDash: [6, 4],
                 borderWidth: 1, borderColor: '#b3261e',
                 data: [{x: Math.min.apply(null, xs), y: plot.limit},
                        {x: Math.max.apply(null, xs), y: plot.limit}]});
    }
    new Chart(canvas(), {
      type: 'scatter', data: {datasets: sets},
      options: {plugins: {title: {display: true, text: plot.title}},
                scales: {x: axis(plot.x), y: axis(plot.y, {beginAtZero: true})}}
    });
  }
})();
