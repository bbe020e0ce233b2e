// A frame shows, while the pointer is on it, the same view of what the gallery's list names.
for (const gallery of document.querySelectorAll('.gallery')) {
  const choice = document.querySelector(`select[data-gallery="${gallery.id}"]`);
  const other = frame =>
      gallery.querySelector(`figure[data-name="${CSS.escape(choice.value)}"] .${frame.dataset.flip} img`);
  for (const frame of gallery.querySelectorAll('.frame[data-flip]')) {
    const image = frame.querySelector('img'), own = image.src;
    const flip = on => {
      const source = other(frame);
      if (on && (!source || source === image)) return;
      image.src = on ? source.src : own;
      frame.classList.toggle('flipped', on);
      frame.querySelector('b').textContent = choice.value;
    };
    frame.addEventListener('pointerenter', () => flip(true));
    frame.addEventListener('pointerleave', () => flip(false));
  }
}
